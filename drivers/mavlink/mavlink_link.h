#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/time.h"
#include "drivers/mavlink/autopilot_link.h"
#include "drivers/mavlink/autopilot_monitor.h"
#include "drivers/mavlink/link_parameters.h"

namespace nanomap {

struct LinkCounters {
  std::uint64_t setpoints_sent = 0;
  std::uint64_t others_sent = 0;
  std::uint64_t refused = 0;          ///< messages that were not finite, or that MAVSDK refused
  std::uint64_t stale_setpoints = 0;  ///< too old when they were about to leave (outgoing_gate.h)
  std::uint64_t received = 0;         ///< messages of the autopilot that are of use here
  std::uint64_t malformed = 0;        ///< of those that could not be read
  AutopilotMonitorCounters autopilot;
};

/// The port of the URL is another process's: the flight process's, say.
class PortTaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The MAVLink connection to the vehicle's autopilot, through MAVSDK. A message is sent when and only when send() is
/// called: no setpoint is ever repeated, and one that was held up for kMaxSetpointAge is dropped. The vehicle's mode
/// and its arming are the pilot's: nothing here changes them. Threads: keepAlive() and send() from one thread, which
/// they cost the time to queue a message; the rest from any. MAVSDK receives and sends on threads of its own.
class MavlinkLink : public AutopilotLink {
 public:
  using Clock = std::function<Time()>;

  /// Opens the connection; the autopilot may appear later.
  /// @param now  the process's clock, read from any thread; must neither block nor throw
  /// @throws PortTaken, std::invalid_argument, std::runtime_error naming the parameter or the URL and what to do about
  /// it
  MavlinkLink(const LinkParameters& parameters, Clock now);
  ~MavlinkLink() override;

  void keepAlive(SystemStatus status) override;
  [[nodiscard]] SendResult send(const LocalNedTarget& target) override;
  [[nodiscard]] SendResult send(const ObstacleDistances& distances) override;
  [[nodiscard]] SendResult send(const OdometryMessage& odometry) override;
  [[nodiscard]] SendResult sendText(Severity severity, std::string_view text) override;
  [[nodiscard]] AutopilotState autopilot() const override;
  [[nodiscard]] std::optional<AutopilotPose> takePose() override;
  [[nodiscard]] LinkCounters counters() const;

  /// The system id of an autopilot that is heard as well as or instead of the vehicle's (LinkParameters::system_id),
  /// looked for once a second; empty if there is none. It gets no setpoint and no command; but messages that have no
  /// addressee, ODOMETRY and OBSTACLE_DISTANCE among them, go to everyone on the link.
  [[nodiscard]] std::optional<std::uint8_t> otherAutopilot() const;

  /// Asks for a parameter of the autopilot, which may not answer. Nothing here ever sets one. Threads: that of
  /// keepAlive().
  [[nodiscard]] SendResult requestParameter(const std::string& name);
  /// The parameter as it was last told; empty if it was not.
  [[nodiscard]] std::optional<double> parameter(const std::string& name) const;

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace nanomap
