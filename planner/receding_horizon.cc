#include "planner/receding_horizon.h"

namespace nanomap {

Decision RecedingHorizon::step(const ChainSnapshot& snapshot, const VehicleState& measured,
                               const std::optional<Goal>& goal, Time now) {
  Decision decision = planner_.plan(snapshot, startState(measured, now), goal, now);
  if (isFlyable(decision)) in_force_ = decision;
  return decision;
}

Explanation RecedingHorizon::explain(const ChainSnapshot& snapshot, const VehicleState& measured,
                                     const std::optional<Goal>& goal, Time now) const {
  return planner_.explain(snapshot, startState(measured, now), goal, now);
}

VehicleState RecedingHorizon::startState(const VehicleState& measured, Time now) const {
  const PlannerParameters& parameters = planner_.parameters();
  const Duration age = now - measured.stamp;
  const bool timely = age >= Duration::zero() && age <= parameters.max_state_age;
  if (!timely || !in_force_ || in_force_->consumed.epoch != measured.epoch) return measured;

  // NaN in either is outside of every tolerance.
  const Motion expected = *motionAt(measured.stamp);
  const double position_error_m = (measured.T_W_B.translation_m - expected.position_m).norm();
  const double velocity_error_m_s = (measured.velocity_W_m_s - expected.velocity_m_s).norm();
  const bool follows = position_error_m <= parameters.tracking.max_position_error_m &&
                       velocity_error_m_s <= parameters.tracking.max_velocity_error_m_s;
  if (!follows) return measured;

  const Motion motion = *motionAt(now);
  VehicleState state = measured;
  state.stamp = now;
  state.T_W_B.translation_m = motion.position_m;
  state.velocity_W_m_s = motion.velocity_m_s;
  state.acceleration_W_m_s2 = motion.acceleration_m_s2;
  return state;
}

std::optional<Motion> RecedingHorizon::motionAt(Time time) const {
  if (!in_force_) return std::nullopt;
  return in_force_->brake.sample(time);
}

bool isFlyable(const Decision& decision) {
  return decision.candidate.has_value() && decision.reason != Reason::kNothingVerified;
}

}  // namespace nanomap
