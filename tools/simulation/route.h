#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

/// Shortest way from the mission's start through its via points to its goal, inside its region, level at the start's
/// altitude, with every obstacle at least `clearance_m` away: corner points in W's x and y, start and goal included.
/// Empty if there is none.
/// Obstacles are rasterised with cells of a quarter metre and the way is searched with A*, then pulled taut.
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> planRoute(const Scene& scene, double clearance_m);

}  // namespace nanomap::simulation
