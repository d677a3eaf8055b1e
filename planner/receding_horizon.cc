#include "planner/receding_horizon.h"

#include "planner/input_check.h"

namespace nanomap {

namespace {

/// From where the motion in force ends, it is over.
constexpr double kAllButThere_m = 0.05;

/// What is steered for from `start`: a goal that cannot be is the planner's to refuse.
std::optional<Goal> steered(Arrival& arrival, Detour& detour, const VehicleState& start,
                            const std::optional<Goal>& goal) {
  if (!isPlausible(start) || goalFault(goal, start)) return goal;
  return detour.steer(start, arrival.steer(*goal));
}

void nameDetour(Decision& decision, const Detour& detour) {
  if (decision.reason == Reason::kFlying && detour.isTurned()) decision.reason = Reason::kGoingRound;
}

}  // namespace

Decision RecedingHorizon::step(const ChainSnapshot& snapshot, const VehicleState& measured,
                               const std::optional<Goal>& goal, Time now) {
  const VehicleState start = startState(measured, now);
  const std::optional<Trajectory> rest = restInForce(measured, now);
  Decision decision = planner_.plan(snapshot, start, steered(arrival_, detour_, start, goal), now,
                                    {rest ? &*rest : nullptr, asideOf(measured, now)});
  arrival_.note(decision);
  detour_.note(decision.reason);
  nameDetour(decision, detour_);
  if (isFlyable(decision)) in_force_ = decision;
  return decision;
}

void RecedingHorizon::release() {
  in_force_.reset();
  arrival_ = Arrival(planner_.parameters().objective.goal_tolerance_m);
  detour_ = Detour(planner_.parameters().detour);
}

Explanation RecedingHorizon::explain(const ChainSnapshot& snapshot, const VehicleState& measured,
                                     const std::optional<Goal>& goal, Time now) const {
  const VehicleState start = startState(measured, now);
  Arrival arrival = arrival_;
  Detour detour = detour_;
  const std::optional<Trajectory> rest = restInForce(measured, now);
  Explanation explanation = planner_.explain(snapshot, start, steered(arrival, detour, start, goal), now,
                                             {rest ? &*rest : nullptr, asideOf(measured, now)});
  nameDetour(explanation.decision, detour);
  return explanation;
}

bool RecedingHorizon::follows(const VehicleState& measured, Time now) const {
  const PlannerParameters& parameters = planner_.parameters();
  const Duration age = now - measured.stamp;
  const bool timely = age >= Duration::zero() && age <= parameters.max_state_age;
  if (!timely || !in_force_ || in_force_->consumed.epoch != measured.epoch) return false;

  // NaN in either is outside of every tolerance.
  const Motion expected = expectedAt(measured.stamp);
  const double position_error_m = (measured.T_W_B.translation_m - expected.position_m).norm();
  const double velocity_error_m_s = (measured.velocity_W_m_s - expected.velocity_m_s).norm();
  return position_error_m <= parameters.tracking.max_position_error_m &&
         velocity_error_m_s <= parameters.tracking.max_velocity_error_m_s;
}

std::optional<Trajectory> RecedingHorizon::restInForce(const VehicleState& measured, Time now) const {
  if (!follows(measured, now) || now < in_force_->stamp) return std::nullopt;
  // By the paper's rule no brake is verified, and none is kept.
  if (planner_.parameters().stop_check == StopCheck::kPaper) return std::nullopt;
  const Trajectory rest = in_force_->brake.rest(now);
  // A vehicle that all but stands stops, looks around and moves away by plans of its own.
  const double left_m = (rest.atEnd().position_m - rest.atStart().position_m).norm();
  return left_m < kAllButThere_m ? std::nullopt : std::optional(rest);
}

VehicleState RecedingHorizon::startState(const VehicleState& measured, Time now) const {
  if (!follows(measured, now)) return measured;
  const Motion motion = *motionAt(now);
  VehicleState state = measured;
  state.stamp = now;
  state.T_W_B.translation_m = motion.position_m;
  state.velocity_W_m_s = motion.velocity_m_s;
  state.acceleration_W_m_s2 = motion.acceleration_m_s2;
  return state;
}

Vec3 RecedingHorizon::asideOf(const VehicleState& measured, Time now) const {
  if (!follows(measured, now)) return Vec3::Zero();
  return measured.T_W_B.translation_m - expectedAt(measured.stamp).position_m;
}

/// Of a state that is older than the motion in force: where that comes from.
Motion RecedingHorizon::expectedAt(Time stamp) const {
  const double before_s = toSeconds(in_force_->brake.start() - stamp);
  if (before_s <= 0.0) return in_force_->brake.sample(stamp);
  return advance(in_force_->brake.atStart(), Vec3::Zero(), -before_s);
}

std::optional<Motion> RecedingHorizon::motionAt(Time time) const {
  if (!in_force_) return std::nullopt;
  return in_force_->brake.sample(time);
}

bool isFlyable(const Decision& decision) {
  return decision.candidate.has_value() && decision.reason != Reason::kNothingVerified;
}

}  // namespace nanomap
