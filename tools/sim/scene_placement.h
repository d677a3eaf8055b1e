#pragma once

#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/ned_from_world.h"
#include "tools/simulation/scene.h"

namespace nanomap::sim {

/// Lays a scene around an autopilot's vehicle: the mission's start is where the vehicle is, seen from above, and the
/// ground is below it if it stands, or else where the autopilot's LOCAL_NED begins, which is where it booted.
/// @param heading_rad  of the way from start to goal, clockwise from north
[[nodiscard]] NedFromWorld placeScene(const simulation::Mission& mission, const AutopilotPose& vehicle, bool on_ground,
                                      double heading_rad);

}  // namespace nanomap::sim
