#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/time.h"
#include "drivers/mavlink/autopilot_monitor.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/obstacle_distance.h"
#include "drivers/mavlink/odometry.h"
#include "drivers/mavlink/setpoint.h"
#include "drivers/mavlink/status_text.h"

namespace nanomap {

struct LinkParameters {
  /// As MAVSDK takes it: udpin://0.0.0.0:14540, udpout://host:port, tcpout://host:port, serial:///dev/ttyACM0:921600
  std::string url = "udpin://0.0.0.0:14540";
  std::uint8_t system_id = 1;       ///< the vehicle's: a companion computer is a part of it
  std::uint8_t component_id = 196;  ///< MAV_COMP_ID_OBSTACLE_AVOIDANCE
  Duration heartbeat_timeout = std::chrono::seconds(3);
  double pose_rate_hz = 50.0;  ///< of the position and attitude that the autopilot is asked to stream
};

enum class SendResult : std::uint8_t {
  kSent,         ///< handed to MAVSDK, which does not wait either: nothing says that it arrived
  kNoAutopilot,  ///< none discovered yet
  kNoClock,      ///< the autopilot has not told its time yet, or had not booted at the message's
  kNotFinite,
  kRefused,  ///< by MAVSDK
};
[[nodiscard]] std::string_view toString(SendResult result);

struct LinkCounters {
  std::uint64_t setpoints_sent = 0;
  std::uint64_t others_sent = 0;
  std::uint64_t refused = 0;          ///< messages that were not finite, or that MAVSDK refused
  std::uint64_t stale_setpoints = 0;  ///< too old when they were about to leave (outgoing_gate.h)
  std::uint64_t received = 0;         ///< messages of the autopilot that are of use here
  std::uint64_t malformed = 0;        ///< of those that could not be read
  AutopilotMonitorCounters autopilot;
};

/// The MAVLink connection to one autopilot, through MAVSDK. A message is sent when and only when send() is called: no
/// setpoint is ever repeated, and one that was held up for kMaxSetpointAge is dropped. The vehicle's mode and its
/// arming are the pilot's: nothing here changes them.
/// Threads: keepAlive() and send() from one thread, which they cost the time to queue a message; the rest from any.
/// MAVSDK receives and sends on threads of its own.
class MavlinkLink {
 public:
  using Clock = std::function<Time()>;

  /// Opens the connection; the autopilot may appear later.
  /// @param now  the process's clock, read from any thread; must neither block nor throw
  /// @throws std::invalid_argument, std::runtime_error naming the parameter or the URL and what to do about it
  MavlinkLink(const LinkParameters& parameters, Clock now);
  ~MavlinkLink();
  MavlinkLink(const MavlinkLink&) = delete;
  MavlinkLink& operator=(const MavlinkLink&) = delete;

  /// To be called at 10 Hz or faster: discovers the autopilot, sends our heartbeat every second and whenever `status`
  /// changes, and asks for the telemetry that is missing. Our heartbeats stop with these calls.
  void keepAlive(SystemStatus status);

  [[nodiscard]] SendResult send(const LocalNedTarget& target);
  [[nodiscard]] SendResult send(const ObstacleDistances& distances);
  [[nodiscard]] SendResult send(const OdometryMessage& odometry);
  /// For the pilot: say it once, in words of his.
  [[nodiscard]] SendResult sendText(Severity severity, std::string_view text);

  [[nodiscard]] AutopilotState autopilot() const;
  /// The oldest pose of the autopilot that nobody has taken; a bounded number of them waits.
  [[nodiscard]] std::optional<AutopilotPose> takePose();
  [[nodiscard]] LinkCounters counters() const;

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace nanomap
