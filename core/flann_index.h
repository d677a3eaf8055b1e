#pragma once

#include <memory>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/nearest_point_index.h"

namespace nanomap {

/// FLANN's single k-d tree (leaf size 15) over the in-range returns of `image`.
/// @pre `image` has the camera's size (`imageFault` says so).
/// Allocates when built; each query costs FLANN's own allocations and none of ours.
[[nodiscard]] std::unique_ptr<NearestPointIndex> buildFlannIndex(const DepthImage& image, const CameraModel& camera);

}  // namespace nanomap
