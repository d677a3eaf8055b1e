#pragma once

#include <cstdint>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

/// Blocks of buildings along streets that cross at right angles, with lamp posts, cars and trees at the kerbs. The goal
/// lies diagonally across the blocks, so that the flight has to turn corners. The seed draws buildings and furniture.
[[nodiscard]] Scene makeUrban(std::uint64_t seed);

}  // namespace nanomap::simulation
