#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/outgoing_gate.h"
#include "tests/fuzz/require.h"

/// The bytes are the fields of a message, whichever it is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  const std::string_view fields(reinterpret_cast<const char*>(data), size);
  static_cast<void>(fromJson<HeartbeatMessage>(fields));
  static_cast<void>(fromJson<LandedStateMessage>(fields));
  if (const auto position = fromJson<LocalPositionMessage>(fields)) {
    fuzz::require(position->position_NED_m.allFinite() && position->velocity_NED_m_s.allFinite());
  }
  if (const auto attitude = fromJson<AttitudeMessage>(fields)) {
    fuzz::require(attitude->R_NED_FRD.coeffs().allFinite());
  }
  for (const auto* name : {"HEARTBEAT", "SET_POSITION_TARGET_LOCAL_NED", "STATUSTEXT"}) {
    for (const bool own_heartbeats : {false, true}) {
      static_cast<void>(judgeOutgoing(name, fields, own_heartbeats, Time(std::chrono::seconds(10))));
    }
  }
  return 0;
}
