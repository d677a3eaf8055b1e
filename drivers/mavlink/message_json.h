#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/time.h"
#include "drivers/mavlink/autopilot_messages.h"
#include "drivers/mavlink/obstacle_distance.h"
#include "drivers/mavlink/odometry.h"
#include "drivers/mavlink/setpoint.h"
#include "drivers/mavlink/status_text.h"

/// Messages as MAVSDK takes and gives them: their fields as JSON, NaN being null.
/// Threads: functions of their arguments. Allocate.
namespace nanomap {

/// Whom a message is for.
struct MavlinkAddress {
  std::uint8_t system_id = 1;
  std::uint8_t component_id = 1;  ///< MAV_COMP_ID_AUTOPILOT1
};

/// MAV_STATE, as far as this process has such states.
enum class SystemStatus : std::uint8_t {
  kBoot = 1,
  kStandby = 3,    ///< can take over
  kActive = 4,     ///< flies
  kCritical = 5,   ///< can still fly a brake
  kEmergency = 6,  ///< cannot
};

/// MAV_CMD_SET_MESSAGE_INTERVAL.
struct MessageIntervalRequest {
  std::uint32_t message_id = 0;
  Duration interval{};
};

/// PARAM_REQUEST_READ.
struct ParameterRequest {
  std::string name;  ///< at most 16 bytes
};

[[nodiscard]] std::string toJson(SystemStatus status);  ///< HEARTBEAT
[[nodiscard]] std::string toJson(const LocalNedTarget& target, const MavlinkAddress& to);
[[nodiscard]] std::string toJson(const ObstacleDistances& distances);
/// @param since_boot  the message's stamp on the autopilot's own clock
[[nodiscard]] std::string toJson(const OdometryMessage& odometry, Duration since_boot);
[[nodiscard]] std::string toJson(const StatusTextChunk& chunk);
[[nodiscard]] std::string toJson(const MessageIntervalRequest& request, const MavlinkAddress& to);
[[nodiscard]] std::string toJson(const ParameterRequest& request, const MavlinkAddress& to);

/// The fields in text that nobody vouches for; empty if one that is read is missing, of another type, out of its
/// range, or not finite.
template <class Message>
[[nodiscard]] std::optional<Message> fromJson(std::string_view fields);
template <>
[[nodiscard]] std::optional<HeartbeatMessage> fromJson(std::string_view fields);
template <>
[[nodiscard]] std::optional<LocalPositionMessage> fromJson(std::string_view fields);
template <>
[[nodiscard]] std::optional<AttitudeMessage> fromJson(std::string_view fields);
template <>
[[nodiscard]] std::optional<LandedStateMessage> fromJson(std::string_view fields);
template <>
[[nodiscard]] std::optional<ParameterMessage> fromJson(std::string_view fields);

/// One unsigned field of a message; empty as above.
[[nodiscard]] std::optional<std::uint32_t> fieldFromJson(std::string_view fields, const char* name);

}  // namespace nanomap
