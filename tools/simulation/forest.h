#pragma once

#include <cstdint>

#include "tools/simulation/scene.h"

namespace nanomap::simulation {

struct ForestParameters {
  double length_m = 110.0;           ///< from start to goal, along W's x
  double half_width_m = 28.0;        ///< to each side of the line from start to goal
  double altitude_m = 2.0;           ///< of start and goal
  double trees_per_m2 = 0.07;        ///< at least; trees that close corridors come on top
  double min_spacing_m = 2.7;        ///< between trunk axes, so that a way through remains
  double corridor_radius_m = 0.4;    ///< a tube this wide fits along no straight line ...
  double corridor_length_m = 100.0;  ///< ... of this length that starts at the start and stays inside the forest
};

/// Trunks, thin branches at flight altitude, crowns above. Trees are drawn at random with a spacing; then every heading
/// that is still free over the corridor's length gets a tree of its own, so that no straight flight leads through.
/// @throws std::invalid_argument if so many trees do not fit with that spacing
[[nodiscard]] Scene makeForest(std::uint64_t seed, const ForestParameters& parameters = {});

}  // namespace nanomap::simulation
