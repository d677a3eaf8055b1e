#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/camera_model.h"
#include "core/chain.h"
#include "core/depth_image.h"
#include "core/view_pool.h"

namespace nanomap::bench {

/// Depth frames and poses of one vehicle, held in memory.
struct RecordedFlight {
  std::shared_ptr<const CameraModel> camera;
  std::vector<DepthImage> frames;  ///< by increasing stamp
  std::vector<BodyPose> poses;     ///< by increasing stamp, from before the first frame to after the last
};

/// A chain that has room for `views` views and holds what `flight` has recorded up to its frame number `frames`, and
/// all poses but the last: the next frame can be inserted with it. @pre the flight has so many frames, and poses
/// @param pool  the views' storage
[[nodiscard]] Chain chainOf(const RecordedFlight& flight, std::size_t views, std::size_t frames, ViewPool& pool);

}  // namespace nanomap::bench
