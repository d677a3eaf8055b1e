#include "planner/motion_limits.h"

#include <algorithm>
#include <cmath>

namespace nanomap {

double MotionLimits::horizontal_m_s2(double speed_m_s) const {
  return std::lerp(horizontal_at_rest_m_s2, horizontal_at_full_m_s2, std::min(speed_m_s / full_speed_m_s, 1.0));
}

double MotionLimits::rampFor_s(double change_m_s2) const { return std::max(ramp_s, change_m_s2 / jerk_m_s3); }

}  // namespace nanomap
