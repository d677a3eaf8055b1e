#pragma once

#include "core/time.h"

namespace nanomap {

/// When a camera that goes on sending is stuck all the same: its noise makes every frame another one, if it looks at
/// anything at all.
struct StuckDepthParameters {
  int images = 3;  ///< that repeat an earlier one to the last count; 0: never stuck
  double motion_m =
      0.25;               ///< of the poses since that one: what a frame without noise shows of a standing vehicle is so
  double turn_rad = 0.1;  ///< or this, since then
};

/// When what we know is too old to be flown on, and for how long that is borne.
struct SafetyParameters {
  Duration max_plan_age = std::chrono::milliseconds(150);
  Duration max_depth_age = std::chrono::milliseconds(200);  ///< of its exposure
  Duration max_pose_age = std::chrono::milliseconds(200);
  Duration max_stamp_lead = std::chrono::milliseconds(50);  ///< farther ahead of our time is another clock
  Duration max_step =
      std::chrono::milliseconds(200);  ///< between two steps, or two setpoints that get out: else held up
  Duration critical_after = std::chrono::milliseconds(500);
  Duration settle = std::chrono::milliseconds(500);  ///< without a fault, before it counts as over
  Duration patience = std::chrono::seconds(2);       ///< that a standing vehicle has with a fault
  Duration stop_margin = std::chrono::seconds(2);    ///< after a brake's planned end, whatever is known
  double standstill_m_s = 0.3;                       ///< slower than that, the vehicle stands
  StuckDepthParameters stuck_depth;
};

/// @throws std::invalid_argument naming the parameter
void check(const SafetyParameters& parameters);

}  // namespace nanomap
