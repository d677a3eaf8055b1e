#include "tools/sim/live_flyer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nanomap::sim {
namespace {

/// AutopilotLink wants to be kept alive at 10 Hz or faster.
constexpr Duration kSignOfLife = std::chrono::milliseconds(50);

/// A motion that is continued for longer has little to do with the vehicle's.
constexpr Duration kOldestTruth = std::chrono::seconds(1);

/// A vehicle that stands at the goal is watched for this long: it has to stay clear of everything, and the flight
/// process says that it has arrived only when that has been so for a second.
constexpr Duration kStays = std::chrono::seconds(3);

}  // namespace

LiveFlyer::LiveFlyer(const Configuration& configuration, const simulation::Scene& scene, double vehicle_radius_m,
                     Duration frame_period, TrueMotion motion, const SensorFaultPlanParameters& faults,
                     const std::vector<PlannedMessageFault>& message_faults, LiveSurroundings surroundings)
    : scene_(scene),
      arrival_tolerance_m_(configuration.planner.objective.goal_tolerance_m + kTrackingAllowance_m),
      frame_period_(frame_period),
      surroundings_(std::move(surroundings)),
      motion_(std::move(motion)),
      judge_(scene, vehicle_radius_m),
      faults_(faults),
      message_faults_(configuration.lcm, message_faults) {}

simulation::VehicleState LiveFlyer::at(Time stamp) {
  waitUntil(stamp);
  takePoses();
  if (stamp - motion_.newest() > kOldestTruth) {
    throw std::runtime_error("the autopilot no longer tells where its vehicle is: the flight cannot go on");
  }
  summary_.worst_lateness = std::max(summary_.worst_lateness, surroundings_.now() - stamp);
  stamp_ = stamp;
  truth_ = motion_.at(stamp);
  return truth_;
}

void LiveFlyer::onEstimate(const simulation::VioEstimate& estimate) {
  const double to_goal_m = (estimate.pose.T_W_B.translation_m - scene_.mission().goal_W).norm();
  judge_.see(stamp_, truth_, to_goal_m <= arrival_tolerance_m_);
}

void LiveFlyer::onArrival(const std::string& channel, Time arrival, Bytes message) {
  waitUntil(arrival);
  const std::optional<Time> departure = judge_.verdict().departure;
  const auto since_departure = departure ? std::optional(arrival - *departure) : std::nullopt;
  message_faults_.pass(channel, arrival, message, since_departure,
                       [&](const std::string& on, Bytes sent) { publish(on, arrival, sent); });
}

void LiveFlyer::publish(const std::string& channel, Time arrival, Bytes message) {
  if (!surroundings_.publish(channel, message)) ++summary_.unpublished;
  if (surroundings_.log != nullptr) surroundings_.log->writeEncoded(channel, arrival, message);
}

generate::SensorFaults LiveFlyer::faultsAt(Time stamp) {
  generate::SensorFaults faults = faults_.at(stamp, judge_.verdict().departure);
  faults.camera_off = faults.camera_off || surroundings_.now() - stamp > frame_period_;
  return faults;
}

bool LiveFlyer::isDone() const {
  const FlightVerdict& verdict = judge_.verdict();
  const bool stays = verdict.outcome == Outcome::kAtGoal && stamp_ - verdict.end >= kStays;
  return stays || verdict.outcome == Outcome::kCollision || surroundings_.stopped();
}

LiveFlightSummary LiveFlyer::summary() const {
  LiveFlightSummary summary = summary_;
  static_cast<FlightVerdict&>(summary) = judge_.verdict();
  summary.extrapolation = motion_.error();
  return summary;
}

void LiveFlyer::waitUntil(Time time) {
  for (;;) {
    const Time now = surroundings_.now();
    if (now >= next_sign_of_life_) {
      surroundings_.autopilot.keepAlive(SystemStatus::kActive);
      next_sign_of_life_ = now + kSignOfLife;
    }
    if (now >= time) return;
    const auto wait = surroundings_.heard.wait(time - now, [&](const ReceivedMessage& message) {
      if (surroundings_.log == nullptr) return;
      surroundings_.log->writeEncoded(std::string(message.channel), surroundings_.now(), message.bytes);
    });
    if (wait == MessageSource::Wait::kEnded) throw std::runtime_error("LCM: the network has failed");
  }
}

void LiveFlyer::takePoses() {
  while (const auto pose = surroundings_.autopilot.takePose()) motion_.add(*pose);
}

}  // namespace nanomap::sim
