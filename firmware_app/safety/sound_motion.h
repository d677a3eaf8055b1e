#pragma once

#include "core/decision.h"
#include "planner/motion_limits.h"

namespace nanomap {

/// Can what is flown of a decision be flown: is it finite, keeps it to the limits wherever it does not start beyond
/// them, and does it end at rest? A planner that is in order gives nothing else; one that is not must not reach the
/// autopilot.
/// Threads: a function of its arguments. Allocates: no.
[[nodiscard]] bool isSound(const Decision& decision, const MotionLimits& limits);

}  // namespace nanomap
