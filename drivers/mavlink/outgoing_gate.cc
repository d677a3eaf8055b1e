#include "drivers/mavlink/outgoing_gate.h"

#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/setpoint.h"

namespace nanomap {

GateVerdict judgeOutgoing(std::string_view message_name, std::string_view fields, bool own_heartbeats, Time now) {
  if (message_name == "SET_POSITION_TARGET_LOCAL_NED") {
    const auto time_boot_ms = fieldFromJson(fields, "time_boot_ms");
    const bool fresh = time_boot_ms && std::chrono::abs(ageOf(*time_boot_ms, now)) <= kMaxSetpointAge;
    return fresh ? GateVerdict::kPass : GateVerdict::kStaleSetpoint;
  }
  if (message_name == "HEARTBEAT" && own_heartbeats) {
    constexpr std::uint32_t kUninitialised = 0;  // MAV_STATE of MAVSDK's heartbeats, and of none of ours
    if (fieldFromJson(fields, "system_status") == kUninitialised) return GateVerdict::kForeignHeartbeat;
  }
  return GateVerdict::kPass;
}

}  // namespace nanomap
