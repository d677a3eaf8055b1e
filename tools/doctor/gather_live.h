#pragma once

#include "core/time.h"
#include "tools/doctor/facts.h"

namespace nanomap::doctor {

/// Listens to the network and to the autopilot for a while, and puts what it learns into `facts`, whose configuration
/// says where. To the autopilot it sends heartbeats, and requests for telemetry and parameters; nothing that moves or
/// changes it.
void gatherLive(Facts& facts, Duration listen);

}  // namespace nanomap::doctor
