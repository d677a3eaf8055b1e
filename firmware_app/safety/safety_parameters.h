#pragma once

#include "core/time.h"

namespace nanomap {

/// When what we know is too old to be flown on, and for how long that is borne.
struct SafetyParameters {
  Duration max_plan_age = std::chrono::milliseconds(150);
  Duration max_depth_age = std::chrono::milliseconds(200);  ///< of its exposure
  Duration max_pose_age = std::chrono::milliseconds(200);
  Duration max_stamp_lead = std::chrono::milliseconds(50);  ///< farther ahead of our time is another clock
  Duration max_step = std::chrono::milliseconds(200);       ///< between two steps of the state machine: else held up
  Duration critical_after = std::chrono::milliseconds(500);
  Duration settle = std::chrono::milliseconds(500);  ///< without a fault, before it counts as over
  Duration patience = std::chrono::seconds(2);       ///< that a standing vehicle has with a fault
  Duration stop_margin = std::chrono::seconds(2);    ///< after a brake's planned end, whatever is known
  double standstill_m_s = 0.3;                       ///< slower than that, the vehicle stands
};

/// @throws std::invalid_argument naming the parameter
void check(const SafetyParameters& parameters);

}  // namespace nanomap
