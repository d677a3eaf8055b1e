#pragma once

#include <optional>

#include "core/pose_buffer.h"
#include "core/vehicle_state.h"
#include "drivers/lcm/convert.h"

namespace nanomap {

/// How the vehicle moves at a pose of the estimator's stream. Where the estimator gives no velocity (bot_core.pose_t,
/// whose publishers disagree on its frame, never does), it is the mean one over the last 0.1 s of poses, with no
/// acceleration; without such poses of the same epoch, or with a step among them that no vehicle makes, it is NaN, so
/// that a planner finds the state invalid, and what is in force is flown on meanwhile.
/// @param motion  as sent with the pose, if it was
/// @param poses   those received so far, this one among them
[[nodiscard]] VehicleState vehicleStateAt(const BodyPose& pose, const std::optional<BodyMotion>& motion,
                                          const PoseBuffer& poses);

}  // namespace nanomap
