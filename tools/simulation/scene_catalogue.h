#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

inline constexpr std::array<std::string_view, 4> kSceneNames = {"forest", "wall", "warehouse", "urban"};

/// The scene called `name`, drawn from `seed`.
/// @throws std::invalid_argument naming the scenes there are, if it is none of kSceneNames
[[nodiscard]] Scene makeScene(std::string_view name, std::uint64_t seed);

}  // namespace nanomap::simulation
