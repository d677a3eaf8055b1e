#pragma once

#include <vector>

#include "core/camera_model.h"
#include "tools/doctor/agreement.h"

namespace nanomap::doctor {

/// A trial, and how well consecutive frames agree under it.
struct JudgedTrial {
  Trial trial;
  double agreement = 0.0;  ///< 0 to 1
};

/// A mount near to the one given, under which they agree best: turned about the body's axes by ever smaller steps, down
/// to one degree, for as long as that helps.
[[nodiscard]] JudgedTrial refined(const std::vector<FramePair>& pairs, const CameraModel& camera, JudgedTrial start);

}  // namespace nanomap::doctor
