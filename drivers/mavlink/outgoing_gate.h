#pragma once

#include <cstdint>
#include <string_view>

#include "core/time.h"

namespace nanomap {

/// A setpoint older than this never leaves: whatever held it up (a full serial line, a stopped process), it asks for a
/// motion that nobody has verified for the present.
inline constexpr Duration kMaxSetpointAge = std::chrono::milliseconds(200);

enum class GateVerdict : std::uint8_t {
  kPass,
  kStaleSetpoint,
  kForeignHeartbeat,  ///< MAVSDK's own, which knows nothing of our state
};

/// What is to become of a message that MAVSDK is about to send.
/// @param fields  its fields as JSON
/// @param own_heartbeats  we send heartbeats; without, MAVSDK's own one makes us known to the autopilot
/// Threads: a function of its arguments. Allocates.
[[nodiscard]] GateVerdict judgeOutgoing(std::string_view message_name, std::string_view fields, bool own_heartbeats,
                                        Time now);

}  // namespace nanomap
