#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/obstacle_distance.h"
#include "drivers/mavlink/odometry.h"
#include "drivers/mavlink/setpoint.h"
#include "drivers/mavlink/status_text.h"

namespace nanomap {

enum class SendResult : std::uint8_t {
  kSent,         ///< handed to MAVSDK, which does not wait either: nothing says that it arrived
  kNoAutopilot,  ///< none discovered yet
  kNoClock,      ///< the autopilot has not told its time yet, or had not booted at the message's
  kNotFinite,
  kRefused,  ///< by MAVSDK
};
[[nodiscard]] std::string_view toString(SendResult result);

/// The way to one autopilot and back: over MAVLink (mavlink_link.h), or to a simulated one in the same process.
/// A message is sent when and only when send() is called. The vehicle's mode and its arming are the pilot's.
/// Threads: keepAlive(), send() and takePose() from one.
class AutopilotLink {
 public:
  virtual ~AutopilotLink() = default;
  AutopilotLink(const AutopilotLink&) = delete;
  AutopilotLink& operator=(const AutopilotLink&) = delete;

  /// To be called at 10 Hz or faster: discovers the autopilot, sends our heartbeat every second and whenever `status`
  /// changes, and asks for the telemetry that is missing. Our heartbeats stop with these calls.
  virtual void keepAlive(SystemStatus status) = 0;

  [[nodiscard]] virtual SendResult send(const LocalNedTarget& target) = 0;
  [[nodiscard]] virtual SendResult send(const ObstacleDistances& distances) = 0;
  [[nodiscard]] virtual SendResult send(const OdometryMessage& odometry) = 0;
  /// For the pilot: say it once, in words of his.
  [[nodiscard]] virtual SendResult sendText(Severity severity, std::string_view text) = 0;

  [[nodiscard]] virtual AutopilotState autopilot() const = 0;
  /// The oldest pose of the autopilot that nobody has taken; a bounded number of them waits.
  [[nodiscard]] virtual std::optional<AutopilotPose> takePose() = 0;

 protected:
  AutopilotLink() = default;
};

}  // namespace nanomap
