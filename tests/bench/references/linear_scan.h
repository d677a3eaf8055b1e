#pragma once

#include <span>
#include <vector>

#include "core/geometry.h"

namespace nanomap::bench {

/// The truth: distances [m] to the nearest `count` of all points, ascending, in the float arithmetic that
/// core/nearest_point_index.h asks for.
[[nodiscard]] std::vector<float> nearestDistances(std::span<const Vec3f> points_C, const Vec3f& p_C, std::size_t count);

}  // namespace nanomap::bench
