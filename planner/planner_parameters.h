#pragma once

#include "core/time.h"
#include "planner/detour.h"
#include "planner/heading.h"
#include "planner/motion_limits.h"
#include "planner/objective.h"
#include "planner/primitive_library.h"
#include "planner/trajectory_risk.h"

namespace nanomap {

/// What a candidate must show beyond a motion within the chance constraint.
enum class StopCheck : std::uint8_t {
  kVerified,  ///< its brake is within the constraint too, and ends in space seen as free
  kPaper,     ///< nothing: the place where it would stand only enters the objective
};

/// How far ahead a primitive must be safe: as long as it takes to fly `distance_m` at the present speed, within limits.
/// Its acceleration is held for `push_s` only: a turn that goes on to the horizon leads through a gap between two trees
/// less often than a short one and the straight way on.
struct HorizonParameters {
  double push_s = 0.4;  ///< at least `brake_after_s`
  double min_s = 1.0;   ///< times the speed, no farther than the camera's range: what lies beyond is not safe
  double max_s = 1.5;   ///< the quotient has no bound at rest
  double distance_m = 3.0;

  [[nodiscard]] PrimitiveTimes at(double speed_m_s) const;
};

/// How far the vehicle may be from the motion in force and still be taken to follow it. With 0 every plan starts from
/// the state as measured. What is planned then is told from the motion in force on, and judged where the vehicle is.
struct TrackingTolerance {
  double max_position_error_m = 0.5;
  double recovery_s = 2.0;              ///< until it is back on the motion; 0: it is judged where it should be
  double max_velocity_error_m_s = 1.5;  ///< a vehicle lags behind its velocity wherever it is pushed
};

struct PlannerParameters {
  MotionLimits limits;
  HorizonParameters horizon;
  GoalDirectedParameters goal_directed;
  ObjectiveParameters objective;
  RiskParameters risk;
  HeadingParameters heading;
  DetourParameters detour;
  TrackingTolerance tracking;

  StopCheck stop_check = StopCheck::kVerified;
  double brake_after_s =
      0.25;                ///< a plan in force is younger: above the plan period plus the age at which one is stale
  int samples = 20;        ///< steps over a primitive's horizon, at least (planner/stretches.h)
  int brake_samples = 10;  ///< over its brake
  bool early_exit = true;  ///< skip what cannot change the choice; without it the choice is the same
  Duration max_state_age = std::chrono::milliseconds(200);
};

/// @throws std::invalid_argument naming the first parameter that is out of its range, its value and the range
void check(const PlannerParameters& parameters);

}  // namespace nanomap
