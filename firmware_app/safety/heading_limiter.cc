#include "firmware_app/safety/heading_limiter.h"

#include <algorithm>

#include "core/level_frame.h"

namespace nanomap {

void HeadingLimiter::reset(Time now, double yaw_rad) { last_ = {now, wrapAngle(yaw_rad)}; }

double HeadingLimiter::follow(Time now, double wanted_rad) {
  if (!last_) {
    reset(now, wanted_rad);
  } else {
    const double reach_rad = max_rate_rad_s_ * std::max(0.0, toSeconds(now - last_->stamp));
    const double turn_rad = std::clamp(wrapAngle(wanted_rad - last_->yaw_rad), -reach_rad, reach_rad);
    reset(now, last_->yaw_rad + turn_rad);
  }
  return last_->yaw_rad;
}

}  // namespace nanomap
