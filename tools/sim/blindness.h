#pragma once

#include <string>
#include <vector>

namespace nanomap::sim {

/// Overrides of the configuration (loadConfiguration) under which no obstacle and no status weighs anything: the
/// planner flies straight at its goal. A scene that is flown through safely like this proves nothing.
[[nodiscard]] std::vector<std::string> blindToObstacles();

}  // namespace nanomap::sim
