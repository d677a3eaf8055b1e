#pragma once

#include <cstdint>

#include "core/time.h"
#include "tools/doctor/facts.h"

namespace nanomap::doctor {

/// Listens to the network and to the autopilot for a while, and puts what it learns into `facts`, whose configuration
/// says where. To the autopilot it sends heartbeats, and requests for telemetry and parameters; nothing that moves or
/// changes it.
/// @param component_id  ours in MAVLink
/// @throws std::invalid_argument if that is the flight process's, which the autopilot would take us for
void gatherLive(Facts& facts, std::uint8_t component_id, Duration listen);

}  // namespace nanomap::doctor
