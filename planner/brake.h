#pragma once

#include "core/trajectory.h"
#include "planner/motion_limits.h"

namespace nanomap {

/// The contingency of `motion`: identical with it for `after_s`, then braking to a standstill, where the acceleration
/// is zero too. In closed form, with the jerk limited to the end: the acceleration ramps to a constant one, holds and
/// ramps to zero, once for the horizontal velocity (along what is left of it after the first ramp) and once for the
/// vertical one, each as hard as its limit allows (horizontally the one at full speed, so that braking again on the way
/// is never weaker than the brake in force).
/// Braking starts within the acceleration limits if the motion does. @pre motion has at most 2 pieces
[[nodiscard]] Trajectory brakeAfter(const Trajectory& motion, double after_s, const MotionLimits& limits);

}  // namespace nanomap
