#pragma once

#include <memory>
#include <vector>

#include "core/camera_model.h"
#include "core/chain.h"
#include "core/depth_image.h"

namespace nanomap::bench {

/// A generated flight through the forest, held in memory: what every benchmark works on.
struct RecordedFlight {
  std::shared_ptr<const CameraModel> camera;
  std::vector<DepthImage> frames;  ///< 30 Hz
  std::vector<BodyPose> poses;     ///< 100 Hz, from before the first frame to after the last
};

/// The paper's camera (320x240, 90 x 60 degrees, 20 m) on the simulator's flight, with sensor noise.
/// @throws std::runtime_error if the scene cannot be flown
[[nodiscard]] RecordedFlight recordFlight(std::size_t frame_count);

/// A chain that holds the whole flight.
[[nodiscard]] Chain chainOf(const RecordedFlight& flight);

}  // namespace nanomap::bench
