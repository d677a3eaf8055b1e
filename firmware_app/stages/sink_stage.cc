#include "firmware_app/stages/sink_stage.h"

namespace nanomap {
namespace {

/// OBSTACLE_DISTANCE is wanted at about 10 Hz.
constexpr Duration kObstaclePeriod = std::chrono::milliseconds(100);

/// EKF2 takes external vision at 30 to 50 Hz.
constexpr Duration kOdometryPeriod = std::chrono::milliseconds(20);

bool isDue(std::optional<Time>& last, Time now, Duration period) {
  if (last && now - *last < period) return false;
  last = now;
  return true;
}

BodyPose poseOf(const VehicleState& state) {
  BodyPose pose;
  pose.stamp = state.stamp;
  pose.T_W_B = state.T_W_B;
  pose.epoch = state.epoch;
  pose.sequence = state.sequence;
  return pose;
}

std::optional<Duration> ageOf(const std::optional<Time>& stamp, Time now) {
  if (!stamp) return std::nullopt;
  return now - *stamp;
}

}  // namespace

SinkStage::SinkStage(const SinkParameters& parameters, AutopilotLink& link, const SinkPorts& ports)
    : parameters_(parameters),
      link_(link),
      ports_(ports),
      alignment_(parameters.alignment),
      commander_(parameters.safety, parameters.limits, parameters.max_yaw_rate_rad_s, parameters.feedforward,
                 parameters.send_odometry ? AutopilotWorld::kOurs : AutopilotWorld::kItsOwn) {
  inputs_.recording = parameters.recording;
}

void SinkStage::run(Time now) {
  link_.keepAlive(status_);
  const bool planned = takeIn(now);
  inputs_.autopilot = link_.autopilot();
  inputs_.alignment = alignment_.alignment(now);
  inputs_.ending = ports_.ending.load(std::memory_order_relaxed);
  inputs_.stalled = ports_.stalled.load(std::memory_order_relaxed);

  const Command command = commander_.step(now, inputs_);
  status_ = command.status;
  if (planned && command.plan_refused) ++counters_.plans_refused;
  ports_.flown.store(command.verdict.state == State::kFlying, std::memory_order_relaxed);
  send(now, command);
  if (const auto text = voice_.step(now, command.verdict, inputs_.plan.reason)) {
    if (link_.sendText(text->severity, text->text) == SendResult::kSent) ++counters_.texts;
  }
  if (parameters_.send_obstacles && !isRefused(inputs_) && isDue(obstacles_sent_, now, kObstaclePeriod))
    sendObstacles(now);

  counters_.alignment = alignment_.counters();
  ports_.report.put([&](SinkReport& report) {
    report.verdict = command.verdict;
    report.alignment = inputs_.alignment;
    report.autopilot = inputs_.autopilot;
    report.reason = inputs_.plan.reason;
    report.depth_age = ageOf(inputs_.vehicle.newest_view, now);
    report.pose_age = inputs_.vehicle.state ? ageOf(inputs_.vehicle.state->stamp, now) : std::nullopt;
    report.plan_age = inputs_.plan.in_force ? ageOf(inputs_.plan.in_force->stamp, now) : std::nullopt;
    report.counters = counters_;
  });
}

bool SinkStage::takeIn(Time now) {
  while (ports_.vehicle.pop([this](const VehicleReport& report) { inputs_.vehicle = report; })) {
    if (!inputs_.vehicle.state) continue;
    alignment_.addWorldPose(poseOf(*inputs_.vehicle.state));
    if (parameters_.send_odometry && !isRefused(inputs_) &&
        isDue(odometry_sent_, inputs_.vehicle.state->stamp, kOdometryPeriod)) {
      sendOdometry(*inputs_.vehicle.state);
    }
  }
  while (const auto pose = link_.takePose()) alignment_.addAutopilotPose(*pose);
  const bool planned = ports_.plans.take([this](const PlanReport& report) { inputs_.plan = report; });
  if (planned) ports_.latencies.push([&](Duration& slot) { slot = now - inputs_.plan.newest_view; });
  return planned;
}

void SinkStage::send(Time now, const Command& command) {
  const bool sent = command.motion && link_.send(command.target) == SendResult::kSent;
  if (command.motion) ++(sent ? counters_.setpoints : counters_.setpoints_failed);
  if (sent || !command.motion) {
    inputs_.unsent_since.reset();
  } else if (!inputs_.unsent_since) {
    inputs_.unsent_since = now;
  }
  ports_.setpoints.push([&](SentSetpoint& slot) {
    slot = {now, command.verdict, sent ? command.motion : std::nullopt};
  });
}

void SinkStage::sendOdometry(const VehicleState& state) {
  VioOdometry odometry;
  odometry.stamp = state.stamp;
  odometry.epoch = state.epoch;
  odometry.T_W_B = state.T_W_B;
  odometry.pose_covariance_W = poseCovariance(parameters_.odometry);
  if (state.velocity_W_m_s.allFinite()) {
    odometry.velocity_W_m_s = state.velocity_W_m_s;
    odometry.velocity_covariance_B = velocityCovariance(parameters_.odometry);
  }
  (void)link_.send(toFrd(odometry));  // the link counts what it refuses
}

void SinkStage::sendObstacles(Time now) {
  const bool fresh = ports_.newest.take([&](const ChainSnapshot& newest) {
    (void)link_.send(obstacleDistances(newest, parameters_.obstacle_band, parameters_.query));
  });
  if (!fresh) obstacles_sent_ = now - kObstaclePeriod;  // as soon as there is something to tell
}

}  // namespace nanomap
