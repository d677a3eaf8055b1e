#pragma once

#include <cstdint>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

/// The paper's simulated flight (section V): start at 5 m altitude, goal 200 m ahead, and 100 m ahead a wide building
/// whose upper floor hangs over towards the vehicle, with its underside near the flight altitude. The seed draws the
/// building's sizes and what stands before it.
[[nodiscard]] Scene makeWall(std::uint64_t seed);

}  // namespace nanomap::simulation
