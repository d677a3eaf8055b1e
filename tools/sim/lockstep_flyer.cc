#include "tools/sim/lockstep_flyer.h"

#include <algorithm>
#include <cmath>

#include "planner/receding_horizon.h"

namespace nanomap::sim {
namespace {

/// The clock of the messages is the flight process's own.
constexpr Duration kRealtimeAhead{};

double yawTowardsGoal(const simulation::Mission& mission) {
  const Vec3 to_goal_W = mission.goal_W - mission.start_W;
  return std::atan2(to_goal_W.y(), to_goal_W.x());
}

}  // namespace

void TrackingError::add(double error_m) {
  worst_m = std::max(worst_m, error_m);
  square_sum_m2 += error_m * error_m;
  ++count;
}

double TrackingError::rms_m() const { return count > 0 ? std::sqrt(square_sum_m2 / static_cast<double>(count)) : 0.0; }

LockstepFlyer::LockstepFlyer(const Configuration& configuration, const simulation::Scene& scene, Time start,
                             const simulation::MulticopterParameters& vehicle, const SensorFaultPlanParameters& faults,
                             const std::optional<std::filesystem::path>& recordings)
    : goal_W_m_(scene.mission().goal_W),
      arrival_tolerance_m_(configuration.planner.objective.goal_tolerance_m + kTrackingAllowance_m),
      judge_(scene, vehicle.radius_m),
      faults_(faults),
      autopilot_(vehicle, scene.mission().start_W, yawTowardsGoal(scene.mission()), start),
      stages_(configuration, kRealtimeAhead, autopilot_),
      setpoint_period_(fromSeconds(1.0 / configuration.mavlink.setpoint_rate_hz)),
      next_setpoint_(start) {
  if (!recordings) return;
  HandOvers& hand_overs = stages_.hand_overs;
  recorder_.emplace(*recordings, configuration,
                    RecorderPorts{hand_overs.steps, hand_overs.decisions, hand_overs.setpoints}, start);
}

LockstepFlyer::~LockstepFlyer() {
  if (recorder_) recorder_->close(autopilot_.now);
}

simulation::VehicleState LockstepFlyer::at(Time stamp) {
  runUntil(stamp);
  return autopilot_.vehicle();
}

void LockstepFlyer::onEstimate(const simulation::VioEstimate& estimate) {
  const double to_goal_m = (estimate.pose.T_W_B.translation_m - goal_W_m_).norm();
  judge_.see(estimate.pose.stamp, autopilot_.vehicle(), to_goal_m <= arrival_tolerance_m_);
  static_cast<FlightVerdict&>(summary_) = judge_.verdict();
  const bool followed = state_ == State::kFlying && in_force_ && in_force_->consumed.epoch == estimate.pose.epoch;
  if (!followed) return;
  const Vec3 told_W_m = in_force_->brake.sample(estimate.pose.stamp).position_m;
  summary_.tracking.add((told_W_m - estimate.pose.T_W_B.translation_m).norm());
}

void LockstepFlyer::onArrival(const std::string& channel, Time arrival, Bytes message) {
  if (isDone()) return;  // what is still under way then has no meaning
  runUntil(arrival);
  const Time taken = stages_.ingest.arrivalAt(arrival);
  if (recorder_) recorder_->onMessage(channel, taken, message);
  const auto kind = stages_.ingest.kindOf(channel);
  if (!kind) return;
  stages_.ingest.take(*kind, message, taken);
  think(taken);
}

generate::SensorFaults LockstepFlyer::faultsAt(Time stamp) { return faults_.at(stamp, summary_.departure); }

void LockstepFlyer::runUntil(Time time) {
  for (; next_setpoint_ <= time; next_setpoint_ += setpoint_period_) {
    autopilot_.advance(next_setpoint_);
    act(next_setpoint_);
  }
  autopilot_.advance(time);
}

void LockstepFlyer::think(Time now) {
  stages_.capture(Duration::zero());
  stages_.index.run();
  stages_.chain.run(now);
  if (!stages_.plan.run(now)) return;
  stages_.hand_overs.newest_decision.take([this](const MadeDecision& made) {
    if (isFlyable(made.decision)) in_force_ = made.decision;
    if (made.flown) summary_.plans.record(made.decision);
  });
}

void LockstepFlyer::act(Time now) {
  stages_.sink.run(now);
  stages_.hand_overs.sink_report.take([this](const SinkReport& report) {
    if (report.verdict.state == State::kBraking && state_ == State::kFlying) ++summary_.braked;
    state_ = report.verdict.state;
  });
  if (!handed_over_ && autopilot_.status == SystemStatus::kStandby) {
    autopilot_.switchToExternalControl();
    handed_over_ = true;
  }
  summary_.failsafes = autopilot_.failsafes();
  if (recorder_) recorder_->run(now);
}

}  // namespace nanomap::sim
