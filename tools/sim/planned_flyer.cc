#include "tools/sim/planned_flyer.h"

#include <algorithm>
#include <cmath>

#include "drivers/lcm/convert.h"

namespace nanomap::sim {
namespace {

double yawTowards(const Vec3& direction_W) { return std::atan2(direction_W.y(), direction_W.x()); }

}  // namespace

PlannedFlyer::PlannedFlyer(const Configuration& configuration, const simulation::Scene& scene, Time start,
                           const simulation::MulticopterParameters& vehicle, const SensorFaultPlanParameters& faults,
                           LogWriter& log)
    : configuration_(configuration),
      log_(log),
      judge_(scene, vehicle.radius_m),
      faults_(faults),
      pipeline_(configuration),
      horizon_(configuration.planner),
      vehicle_(vehicle, scene.mission().start_W, yawTowards(scene.mission().goal_W - scene.mission().start_W)),
      controller_({}),
      command_{Vec3::Zero(), yawTowards(scene.mission().goal_W - scene.mission().start_W)},
      hold_W_{scene.mission().start_W, Vec3::Zero(), Vec3::Zero()},
      now_(start) {}

simulation::VehicleState PlannedFlyer::at(Time stamp) {
  if (stamp > now_) vehicle_.advance(command_, stamp - now_);
  now_ = std::max(now_, stamp);
  return vehicle_.state();
}

void PlannedFlyer::onEstimate(const simulation::VioEstimate& estimate) {
  const Time stamp = estimate.pose.stamp;
  const Motion estimated{estimate.pose.T_W_B.translation_m, estimate.velocity_W_m_s, Vec3::Zero()};
  const Motion setpoint = horizon_.motionAt(stamp).value_or(hold_W_);
  const Duration since = last_estimate_ ? stamp - *last_estimate_ : Duration::zero();
  last_estimate_ = stamp;
  command_.acceleration_W_m_s2 = controller_.acceleration(setpoint, estimated, since);

  const double error_m = (setpoint.position_m - estimated.position_m).norm();
  summary_.tracking.worst_m = std::max(summary_.tracking.worst_m, error_m);
  summary_.tracking.square_sum_m2 += error_m * error_m;
  ++summary_.tracking.count;
  judge_.see(stamp, vehicle_.state(), horizon_.inForce() && horizon_.inForce()->reason == Reason::kAtGoal);
  static_cast<FlightVerdict&>(summary_) = judge_.verdict();
}

generate::SensorFaults PlannedFlyer::faultsAt(Time stamp) { return faults_.at(stamp, summary_.departure); }

void PlannedFlyer::onArrival(const std::string& channel, Time arrival, Bytes message) {
  log_.writeEncoded(channel, arrival, message);
  const auto kind = pipeline_.kindOf(channel);
  if (!kind) return;
  if (pipeline_.feed(*kind, message).views_inserted > 0) plan(arrival);
}

void PlannedFlyer::plan(Time arrival) {
  pipeline_.chain().snapshotInto(snapshot_);
  const Decision decision = horizon_.step(snapshot_, *pipeline_.state(), pipeline_.goal(), snapshot_.stamp);
  if (decision.candidate) command_.yaw_W_rad = decision.yaw_W_rad;
  log_.write(configuration_.lcm.decisions_channel, arrival, toMessage(decision, {.sequence = summary_.plans.total()}));
  summary_.plans.record(decision);
}

}  // namespace nanomap::sim
