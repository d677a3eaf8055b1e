#include "planner/detour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/level_frame.h"

namespace nanomap {
namespace {

// What follows tells noise from what is meant, and is the same for any vehicle and place: nobody has to tune it.

/// A goal that has moved by more since the last plan is another one: corrections for drift move it by less.
constexpr double kSamePlace_m = 1.0;

/// Less is no progress, but noise of the estimator.
constexpr double kProgress_m = 0.2;

/// As much nearer to the goal than it began, a detour has done its work, wherever its course points: a vehicle that
/// flies past a goal nearby would circle it, because the direction to it turns as fast as the course leans back.
constexpr double kDone_m = 3.0;

/// Slower than that, a motion has no direction to lean from.
constexpr double kMoving_m_s = 0.5;

/// A goal that is turned is at least this far away: it is steered for, and never reached, as every plan turns it anew.
constexpr double kLeastReach_m = 10.0;

/// A vehicle on a detour keeps so slow that the direction to its goal turns half as fast as its course can: a faster
/// one is carried past a goal nearby, and circles it.
constexpr double kOfTurnRate = 0.5;

/// Nor need it creep, however near the goal is.
constexpr double kLeastSpeed_m_s = 1.0;

/// Plans that are farther apart do not make for a larger turn.
constexpr Duration kLongestStep = std::chrono::milliseconds(200);

double headingOf(const Vec3& direction_W) { return std::atan2(direction_W.y(), direction_W.x()); }

/// One to each side.
constexpr int kMostAttempts = 2;

constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;

bool isHeldUp(Reason reason) { return reason == Reason::kBlocked || reason == Reason::kNothingVerified; }

Goal turnedAbout(const Vec3& position_W_m, double angle_rad, Goal goal) {
  const Vec3 to_goal_W = goal.position_W_m - position_W_m;
  const double distance_m = to_goal_W.head<2>().norm();
  const double heading_rad = headingOf(to_goal_W) + angle_rad;
  const double reach_m = std::max(distance_m, kLeastReach_m);
  goal.position_W_m.x() = position_W_m.x() + reach_m * std::cos(heading_rad);
  goal.position_W_m.y() = position_W_m.y() + reach_m * std::sin(heading_rad);
  return goal;
}

}  // namespace

Goal Detour::steer(const VehicleState& start, const Goal& goal) {
  if (parameters_.give_up_after <= Duration::zero()) return goal;
  const bool same =
      goal_ && goal_->epoch == goal.epoch && (goal_->position_W_m - goal.position_W_m).norm() <= kSamePlace_m;
  const Vec3 to_goal_W = goal.position_W_m - start.T_W_B.translation_m;
  if (!same) {
    *this = Detour(parameters_);
    least_distance_m_ = to_goal_W.norm();
    last_progress_ = start.stamp;
  }
  const Duration elapsed = std::clamp(start.stamp - last_stamp_, Duration::zero(), kLongestStep);
  watchProgress(start.stamp, elapsed, to_goal_W.norm());
  if (attempt_) {
    follow(start, to_goal_W, elapsed);
    if (isInVain(start)) begin(start, -attempt_->side);
  } else if (start.stamp - last_progress_ >= parameters_.patience && to_goal_W.norm() > parameters_.near_goal_m) {
    const double looks_rad = wrapAngle(yawOf(start.T_W_B.rotation) - headingOf(to_goal_W));
    begin(start, looks_rad >= 0.0 ? 1.0 : -1.0);
  }
  goal_ = goal;
  last_stamp_ = start.stamp;
  if (!isTurned()) return goal;
  Goal turned = turnedAbout(start.T_W_B.translation_m, attempt_->side * attempt_->turn_rad, goal);
  const double turns_in_time_m_s = kOfTurnRate * parameters_.turn_rate_rad_s * to_goal_W.head<2>().norm();
  turned.top_speed_m_s = std::min(goal.top_speed_m_s, std::max(turns_in_time_m_s, kLeastSpeed_m_s));
  return turned;
}

void Detour::watchProgress(Time now, Duration elapsed, double distance_m) {
  const bool nearer = distance_m < least_distance_m_ - kProgress_m;
  const bool retreats = last_reason_ == Reason::kRetreating;
  const bool flies = last_reason_ == Reason::kFlying || last_reason_ == Reason::kKeeping;
  const bool wants_on = flies || retreats || (last_reason_ && isHeldUp(*last_reason_));
  if (nearer || !wants_on) last_progress_ = now;
  if (!nearer && retreats) last_progress_ += elapsed;
  if (!nearer) return;
  least_distance_m_ = distance_m;
  if (!isTurned() || distance_m <= attempt_->distance_m - kDone_m) attempt_.reset();
  attempts_ = attempt_ ? 1 : 0;
}

/// Standing, the course turns away from the goal; moving, it leans back from the motion.
void Detour::follow(const VehicleState& start, const Vec3& to_goal_W, Duration elapsed) {
  const double step_rad = parameters_.turn_rate_rad_s * toSeconds(elapsed);
  double& turn_rad = attempt_->turn_rad;
  if (start.velocity_W_m_s.head<2>().norm() >= kMoving_m_s) {
    const double flown_rad = attempt_->side * (headingOf(start.velocity_W_m_s) - headingOf(to_goal_W));
    const double wanted_rad = turn_rad + wrapAngle(flown_rad - turn_rad) - parameters_.lean_rad;
    turn_rad = std::max(turn_rad + std::clamp(wanted_rad - turn_rad, -step_rad, step_rad), 0.0);
  } else if (last_reason_ && isHeldUp(*last_reason_)) {
    turn_rad += step_rad;
  }
}

bool Detour::isInVain(const VehicleState& start) {
  const double away_m = (start.T_W_B.translation_m - attempt_->began_W_m).norm();
  if (away_m > 2.0 * parameters_.return_m) attempt_->left = true;
  const bool returned = attempt_->left && away_m < parameters_.return_m;
  return returned || attempt_->turn_rad > kFullTurn_rad || start.stamp - attempt_->began > parameters_.give_up_after;
}

/// Unless both sides have been tried.
void Detour::begin(const VehicleState& start, double side) {
  attempt_.reset();
  if (attempts_ == kMostAttempts) return;
  ++attempts_;
  attempt_ = Attempt{
      .side = side, .began_W_m = start.T_W_B.translation_m, .began = start.stamp, .distance_m = least_distance_m_};
}

}  // namespace nanomap
