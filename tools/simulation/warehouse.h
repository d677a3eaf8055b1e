#pragma once

#include <cstdint>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

/// An aisle between two rows of racks in a hall: uprights, shelf beams and pallets at the sides, goods that stand out
/// into the aisle from either side in turn, thin beams across it above the flight altitude. The seed draws the goods.
[[nodiscard]] Scene makeWarehouse(std::uint64_t seed);

}  // namespace nanomap::simulation
