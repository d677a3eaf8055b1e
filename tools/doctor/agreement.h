#pragma once

#include <optional>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/geometry.h"

namespace nanomap::doctor {

/// Two depth frames of one camera, between which the vehicle has moved.
struct FramePair {
  const DepthImage* from = nullptr;
  const DepthImage* to = nullptr;
  Pose T_W_B_from;
  Pose T_W_B_to;
};

/// What is to be tried of the camera.
struct Trial {
  Pose T_B_C;
  double depth_factor = 1.0;  ///< on the camera's metres per count
};

/// What was measured in the first frame, carried by the poses into the second, against what was measured there: the
/// share of points that are found where they should be, 0 to 1, over all pairs. What is hidden or left the view says
/// nothing; of a pair in which hardly anything remains in view the rest counts as lost.
/// @param pairs  of images of the camera's size
/// Empty if there is nothing to compare. Threads: a function of its arguments.
[[nodiscard]] std::optional<double> agreement(const std::vector<FramePair>& pairs, const CameraModel& camera,
                                              const Trial& trial);

}  // namespace nanomap::doctor
