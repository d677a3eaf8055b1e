#pragma once

#include <cstddef>
#include <vector>

#include "core/camera_model.h"
#include "core/pose_buffer.h"
#include "core/time.h"
#include "tools/doctor/agreement.h"
#include "tools/doctor/heard.h"

namespace nanomap::doctor {

/// The poses of what was heard, as a buffer that holds all of them.
[[nodiscard]] PoseBuffer poseBufferOf(const Heard& heard, Duration max_gap);

/// Pairs of frames between which the vehicle has moved enough to tell a wrong mount from a right one, and not so much
/// that they share nothing. Borrows the frames.
/// @param stamp_shift  added to the frames' stamps
[[nodiscard]] std::vector<FramePair> movedPairs(const Heard& heard, const PoseBuffer& poses, const CameraModel& camera,
                                                Duration stamp_shift = {});

}  // namespace nanomap::doctor
