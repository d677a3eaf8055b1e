#pragma once

#include <array>
#include <memory>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/nearest_point_index.h"

namespace nanomap::bench {

/// Leaf sizes among which the best is searched, for each workload of its own. The first is nanoflann's default.
inline constexpr std::array kNanoflannLeaves = {10, 20, 32, 50, 80};

/// nanoflann's k-d tree over the returns in range: exact, distances to the last bit as the interface asks. Its result
/// set starts at the search radius, as nanoflann 1.5's RKNNResultSet does: the tree is pruned by it from the root on.
/// Allocates: to build, not to query.
[[nodiscard]] std::unique_ptr<const NearestPointIndex> buildNanoflannIndex(const DepthImage& image,
                                                                           const CameraModel& camera, int leaf);

}  // namespace nanomap::bench
