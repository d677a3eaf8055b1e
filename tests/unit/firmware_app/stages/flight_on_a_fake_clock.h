#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "drivers/lcm/encode.h"
#include "firmware_app/stages/stages.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"
#include "tools/sim/in_process_autopilot.h"

namespace nanomap::test {

/// What can break between the flight's parts, and how.
enum class Broken { kDepth, kPose, kCorrection, kMavlink, kPlanner, kSink, kClock };
enum class How { kOff, kStuck, kLate, kGarbage, kJumping, kIntermittent, kFrozen, kLossy };

/// A vehicle that does at once what it is told, and stands when it is told nothing.
class ObedientAutopilot : public sim::InProcessAutopilot {
 public:
  static constexpr Duration kStreamTimeout = std::chrono::milliseconds(500);

  using InProcessAutopilot::send;
  [[nodiscard]] SendResult send(const LocalNedTarget& told) override {
    return refuses ? SendResult::kNotFinite : InProcessAutopilot::send(told);
  }

  /// Moves the vehicle over the time since the last call.
  void move(Time until) {
    const double elapsed_s = toSeconds(until - now);
    now = until;
    const bool obeys = state.external_control && target && now - target->at < kStreamTimeout;
    if (!obeys) {
      velocity_NED_m_s.setZero();
      return;
    }
    const LocalNedTarget& told = target->target;
    velocity_NED_m_s = told.velocity_NED_m_s.cast<double>();
    position_NED_m = target->withPosition() ? Vec3(told.position_NED_m.cast<double>() - offset_NED_m)
                                            : Vec3(position_NED_m + velocity_NED_m_s * elapsed_s);
    heading_rad = static_cast<double>(told.yaw_NED_rad);
  }

  Vec3 position_NED_m = Vec3::Zero();
  bool refuses = false;              ///< whatever it is sent
  Vec3 offset_NED_m = Vec3::Zero();  ///< that its own estimate is off by
  Vec3 velocity_NED_m_s = Vec3::Zero();
  double heading_rad = 0.0;
};

/// The whole way from messages to an autopilot, on one thread and a clock of its own: a vehicle in open space towards a
/// far goal, with something 9 m away in every direction that the camera looks in.
class FlightOnAFakeClock {
 public:
  static constexpr Duration kTick = std::chrono::milliseconds(10);
  static constexpr double kHeading_rad = 1.2;  ///< of W in NED

  explicit FlightOnAFakeClock(const Configuration& configuration = FlightOnAFakeClock::configuration())
      : stamps_of_day_(configuration.lcm.clock == ClockDomain::kRealtime),
        stages_(configuration, time_of_day_ahead_, autopilot) {
    autopilot.now = now_;
    autopilot.state.linked = true;
    autopilot.state.armed = true;
    autopilot.state.kind = AutopilotKind::kPx4;
    autopilot.position_NED_m = T_NED_W_.point({0.0, 0.0, 2.0});
    autopilot.heading_rad = T_NED_W_.heading(0.0);
    goal_t goal{};
    goal.position[0] = 500.0;
    goal.position[2] = 2.0;
    goal.top_speed = 5.0;
    send(InputKind::kGoal, goal);
  }

  static Configuration configuration() {
    Configuration configuration;
    configuration.camera = smallCamera();
    return configuration;
  }

  /// Breaks something from now on.
  void breakIt(Broken what, How how) { broken_ = {what, how, now_}; }
  void mend() { broken_.reset(); }

  /// Sets the host's time of day forward, or back. Streams are stamped by it with ClockDomain::kRealtime.
  void setTimeOfDay(Duration forward) { time_of_day_ahead_ += forward; }

  void order() { autopilot.switchToExternalControl(); }

  void run(Duration duration) {
    for (const Time end = now_ + duration; now_ < end;) tick();
  }

  /// The whole process stands still while the world goes on; what arrives meanwhile waits.
  void stopProcess(Duration duration) {
    for (const Time end = now_ + duration; now_ < end;) {
      now_ += kTick;
      autopilot.move(now_);
      sense();
    }
    runStages();
  }

  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] double speed_m_s() const { return autopilot.velocity_NED_m_s.norm(); }
  [[nodiscard]] bool wasIn(State state) const { return first_in_.contains(state); }
  [[nodiscard]] Duration until(State state, Time from) const { return first_in_.at(state) - from; }
  void forgetStates() { first_in_.clear(); }
  [[nodiscard]] std::uint64_t stuckViews() {
    std::uint64_t views = 0;
    stages_.hand_overs.chain_counters.take([&](const ChainStageCounters& counters) { views = counters.stuck_views; });
    return views;
  }
  [[nodiscard]] const std::vector<SentSetpoint>& setpoints() const { return setpoints_; }
  [[nodiscard]] const MadeDecision* decision(std::uint64_t sequence) const {
    const auto found = decisions_.find(sequence);
    return found == decisions_.end() ? nullptr : &found->second;
  }

  ObedientAutopilot autopilot;

 private:
  struct Fault {
    Broken what;
    How how;
    Time since{};
  };

  [[nodiscard]] bool is(Broken what, How how) const { return broken_ && broken_->what == what && broken_->how == how; }
  /// Half of the time, by turns, since the fault began.
  [[nodiscard]] bool everyOther(Duration period) const { return (now_ - broken_->since) / period % 2 == 0; }
  /// Half of all messages, and all of them for 0.3 s of each second.
  [[nodiscard]] bool isLost() {
    const bool pause = (now_ - broken_->since) % std::chrono::seconds(1) < std::chrono::milliseconds(300);
    return random_() % 2 == 0 || pause;
  }
  [[nodiscard]] bool silent(Broken what) const {
    return is(what, How::kOff) || (is(what, How::kIntermittent) && everyOther(std::chrono::milliseconds(300)));
  }

  void tick() {
    now_ += kTick;
    ++ticks_;
    autopilot.move(now_);
    sense();
    runStages();
  }

  void sense() {
    tellAutopilotPose();
    sendPose();
    if (ticks_ % 3 == 0) sendDepth();
    if (ticks_ % 50 == 0) sendCorrection();
    deliverLate();
  }

  void runStages() {
    stages_.capture(Duration::zero());
    stages_.index.run();
    stages_.chain.run(now_);
    const bool planner_runs = !silent(Broken::kPlanner) && !is(Broken::kPlanner, How::kStuck) &&
                              (!is(Broken::kPlanner, How::kLate) || ticks_ % 40 == 0);
    if (planner_runs) stages_.plan.run(now_);
    if (is(Broken::kPlanner, How::kGarbage)) garblePlan();
    autopilot.refuses = is(Broken::kSink, How::kGarbage);
    const bool sink_runs = !silent(Broken::kSink) && !is(Broken::kSink, How::kStuck) &&
                           (!is(Broken::kSink, How::kLate) || ticks_ % 30 == 0);
    if (ticks_ % 2 == 0 && sink_runs) stages_.sink.run(now_);
    while (stages_.hand_overs.decisions.pop([this](const MadeDecision& made) { decisions_[made.sequence] = made; })) {
    }
    while (stages_.hand_overs.setpoints.pop([this](const SentSetpoint& sent) {
      state_ = sent.verdict.state;
      first_in_.try_emplace(state_, sent.stamp);
      setpoints_.push_back(sent);
    })) {
    }
    while (stages_.hand_overs.steps.pop([](const Step&) {})) {
    }
  }

  /// Motions that no planner in order gives, by turns: not a number, infinitely far, harder than the vehicle can,
  /// without an end.
  void garblePlan() {
    const auto& [sequence, last] = *decisions_.rbegin();
    PlanReport report{last.decision, sequence, now_, Reason::kFlying};
    Trajectory& brake = report.in_force->brake;
    report.in_force->stamp = now_;
    Motion start{T_W_B().translation_m, T_NED_W_.directionInWorld(autopilot.velocity_NED_m_s), Vec3::Zero()};
    if (ticks_ % 4 == 1) start.position_m.x() = std::numeric_limits<double>::infinity();
    brake = Trajectory(now_, start);
    if (ticks_ % 4 == 0) brake.append(1.0, Vec3::Constant(std::nan("")));
    if (ticks_ % 4 == 2) brake.append(1.0, {0.0, 500.0, 0.0});
    stages_.hand_overs.plans.put([&](PlanReport& slot) { slot = report; });
  }

  [[nodiscard]] Time stampNow() const {
    if (is(Broken::kClock, How::kLate)) return now_ - std::chrono::seconds(1);
    if (is(Broken::kClock, How::kJumping)) return now_ + std::chrono::milliseconds(300);
    return stamps_of_day_ ? now_ + time_of_day_ahead_ : now_;
  }

  [[nodiscard]] Pose T_W_B() const {
    return {Quat(levelAxes(kHeading_rad - autopilot.heading_rad)), T_NED_W_.pointInWorld(autopilot.position_NED_m)};
  }

  void tellAutopilotPose() {
    if (ticks_ % 2 != 0) return;
    autopilot.state.linked = !silent(Broken::kMavlink);
    if (silent(Broken::kMavlink) || (is(Broken::kMavlink, How::kLossy) && isLost())) return;
    AutopilotPose pose{now_, autopilot.position_NED_m + autopilot.offset_NED_m, autopilot.heading_rad};
    if (is(Broken::kMavlink, How::kStuck)) pose.stamp = broken_->since;
    if (is(Broken::kMavlink, How::kLate)) pose.stamp = now_ - std::chrono::seconds(2);
    if (is(Broken::kMavlink, How::kGarbage)) pose.position_NED_m.setConstant(std::nan(""));
    if (is(Broken::kMavlink, How::kJumping)) pose.position_NED_m.x() += everyOther(std::chrono::seconds(1)) ? 5.0 : 0.0;
    autopilot.poses.push_back(pose);
  }

  void sendPose() {
    BodyPose pose;
    pose.stamp = stampNow();
    pose.sequence = static_cast<std::uint64_t>(ticks_);
    pose.T_W_B = T_W_B();
    const Vec3 velocity_W_m_s = T_NED_W_.directionInWorld(autopilot.velocity_NED_m_s);
    if (is(Broken::kPose, How::kJumping))
      pose.T_W_B.translation_m.y() += everyOther(std::chrono::milliseconds(200)) ? 3.0 : 0.0;
    poses_.push_back({pose.stamp, pose.T_W_B});
    send(InputKind::kPose, toMessage(pose, BodyMotion{velocity_W_m_s, Vec3::Zero(), Vec3::Zero()}), Broken::kPose);
  }

  void sendDepth() {
    DepthImage image = flatImage(camera_, 9000, stampNow() - std::chrono::milliseconds(30));
    image.sequence = static_cast<std::uint64_t>(ticks_);
    if (!is(Broken::kDepth, How::kFrozen)) ++image.pixels[static_cast<std::size_t>(ticks_) % image.pixels.size()];
    if (is(Broken::kDepth, How::kJumping))
      image.stamp += std::chrono::seconds(everyOther(std::chrono::milliseconds(100)) ? 2 : -2);
    send(InputKind::kDepth, toMessage(image, "front", DepthCompression::kRaw), Broken::kDepth);
  }

  void sendCorrection() {
    Correction correction;
    correction.sequence = static_cast<std::uint64_t>(ticks_);
    for (std::size_t i = poses_.size() > 200 ? poses_.size() - 200 : 0; i < poses_.size(); i += 10)
      correction.poses.push_back(poses_[i]);
    if (is(Broken::kCorrection, How::kJumping)) {
      for (CorrectedPose& pose : correction.poses)
        pose.T_W_B.translation_m.y() += everyOther(std::chrono::seconds(1)) ? 5.0 : 0.0;
    }
    send(InputKind::kCorrection, toMessage(correction, now_), Broken::kCorrection);
  }

  template <class Message>
  void send(InputKind kind, const Message& message, std::optional<Broken> channel = std::nullopt) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(encodeInto(message, bytes));
    if (!channel) return take(kind, bytes);
    if (silent(*channel)) return;
    if (is(*channel, How::kStuck)) return take(kind, last_good_[kind]);
    if (is(*channel, How::kLate)) {
      late_.emplace_back(now_ + std::chrono::seconds(1), kind, bytes);
      return;
    }
    if (is(*channel, How::kGarbage)) {
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    } else {
      last_good_[kind] = bytes;
    }
    take(kind, bytes);
  }

  void take(InputKind kind, const std::vector<std::uint8_t>& bytes) {
    stages_.ingest.noteRealtime(time_of_day_ahead_, now_);
    stages_.ingest.take(kind, bytes, stages_.ingest.arrivalAt(now_));
  }

  void deliverLate() {
    while (!late_.empty() && std::get<0>(late_.front()) <= now_) {
      take(std::get<1>(late_.front()), std::get<2>(late_.front()));
      late_.pop_front();
    }
  }

  NedFromWorld T_NED_W_{kHeading_rad, {40.0, -20.0, -3.0}};
  CameraModel camera_{smallCamera()};
  bool stamps_of_day_;
  Duration time_of_day_ahead_ = std::chrono::hours(480'000);
  Stages stages_;
  Time now_ = Time(std::chrono::seconds(1000)) - kTick;
  std::int64_t ticks_ = 0;
  std::optional<Fault> broken_;
  std::mt19937 random_{1};
  std::vector<CorrectedPose> poses_;
  std::map<InputKind, std::vector<std::uint8_t>> last_good_;
  std::deque<std::tuple<Time, InputKind, std::vector<std::uint8_t>>> late_;
  State state_ = State::kWaiting;
  std::map<State, Time> first_in_;
  std::vector<SentSetpoint> setpoints_;
  std::map<std::uint64_t, MadeDecision> decisions_;
};

}  // namespace nanomap::test
