#include "firmware_app/safety/commander.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/firmware_app/safety/healthy.h"

namespace nanomap {
namespace {

constexpr double kTolerance_m = 1e-4;  // of a float, tens of metres away
constexpr Feedforward kFeedforward{
    .setpoint_lead = std::chrono::milliseconds(25), .tilt_lag = std::chrono::milliseconds(60), .drag_1_s = 0.25};
constexpr double kDeg = std::numbers::pi / 180.0;

/// A decision that flies along x from `position` at `speed` for a second and stands then.
Decision flying(Time start, const Vec3& position_W_m, double speed_m_s, std::uint32_t epoch = 0) {
  Decision decision;
  decision.stamp = start;
  decision.candidate = 1;
  decision.reason = Reason::kFlying;
  decision.consumed.epoch = epoch;
  Trajectory brake(start, {position_W_m, {speed_m_s, 0.0, 0.0}, {-speed_m_s, 0.0, 0.0}});
  brake.append(1.0, Vec3::Zero());
  decision.brake = brake;
  decision.brake_verified = true;
  return decision;
}

Alignment aligned(const NedFromWorld& T_NED_W, std::uint32_t epoch = 0) {
  Alignment alignment;
  alignment.verdict = AlignmentVerdict::kGood;
  alignment.T_NED_W = T_NED_W;
  alignment.epoch = epoch;
  return alignment;
}

CommandInputs inputsAt(Time now, const Vec3& position_W_m, double speed_m_s) {
  CommandInputs inputs;
  inputs.vehicle.camera = true;
  inputs.vehicle.newest_view = now - std::chrono::milliseconds(60);
  inputs.vehicle.state.emplace();
  inputs.vehicle.state->stamp = now - std::chrono::milliseconds(10);
  inputs.vehicle.state->T_W_B.translation_m = position_W_m;
  inputs.vehicle.state->velocity_W_m_s = {speed_m_s, 0.0, 0.0};
  inputs.plan.in_force = flying(now - std::chrono::milliseconds(30), position_W_m, speed_m_s);
  inputs.autopilot.linked = true;
  inputs.autopilot.armed = true;
  inputs.alignment = aligned(NedFromWorld(70.0 * kDeg, {100.0, -50.0, -3.0}));
  return inputs;
}

class CommanderInFlight : public ::testing::Test {
 protected:
  CommanderInFlight() {
    for (int i = 0; i < 50; ++i, now_ += kStep) (void)commander_.step(now_, inputsAt(now_, kHere_W_m, 0.0));
    command_ = commander_.step(now_, ordered(inputsAt(now_, kHere_W_m, 0.0)));
  }

  static CommandInputs ordered(CommandInputs inputs) {
    inputs.autopilot.external_control = true;
    inputs.autopilot.external_control_entries = 1;
    return inputs;
  }

  static inline const Vec3 kHere_W_m{5.0, 2.0, 1.5};
  Commander commander_{SafetyParameters{}, MotionLimits{}, 1.0, kFeedforward, AutopilotWorld::kItsOwn};
  Time now_ = atMs(10'000);
  Command command_;
};

TEST(Commander, HoldsWhereTheVehicleIsWhileReady) {
  Commander commander{SafetyParameters{}, MotionLimits{}, 1.0, kFeedforward, AutopilotWorld::kItsOwn};
  const NedFromWorld T_NED_W(70.0 * kDeg, {100.0, -50.0, -3.0});
  const Vec3 here_W{5.0, 2.0, 1.5};
  const Command command = commander.step(atMs(0), inputsAt(atMs(0), here_W, 3.0));
  ASSERT_EQ(command.verdict.state, State::kReady);
  ASSERT_TRUE(command.motion);
  EXPECT_NEAR((command.target.position_NED_m.cast<double>() - T_NED_W.point(here_W)).norm(), 0.0, kTolerance_m);
  EXPECT_EQ(command.target.velocity_NED_m_s, Vec3f::Zero());
  EXPECT_NEAR(command.target.yaw_NED_rad, 70.0 * kDeg, 1e-6);
  EXPECT_EQ(command.status, SystemStatus::kStandby);
}

TEST(Commander, SendsNothingWithoutAlignment) {
  Commander commander{SafetyParameters{}, MotionLimits{}, 1.0, kFeedforward, AutopilotWorld::kItsOwn};
  CommandInputs inputs = inputsAt(atMs(0), Vec3::Zero(), 0.0);
  inputs.alignment = {};
  const Command command = commander.step(atMs(0), inputs);
  EXPECT_EQ(command.verdict.state, State::kWaiting);
  EXPECT_FALSE(command.motion);
  EXPECT_TRUE(command.verdict.faults.has(Fault::kAlignment));
}

TEST(IsRefused, RecordingIsToldToASimulatedAutopilotThatIsHeardAndToNoOther) {
  CommandInputs inputs;
  EXPECT_FALSE(isRefused(inputs));
  inputs.recording = true;
  for (const bool linked : {false, true}) {
    for (const bool simulated : {false, true}) {
      inputs.autopilot.linked = linked;
      inputs.autopilot.simulated = simulated;
      EXPECT_EQ(isRefused(inputs), !(linked && simulated)) << linked << simulated;
    }
  }
}

TEST(Commander, RecordingWaitsForTheAutopilotBeforeItAsksForASimulatedOne) {
  Commander commander{SafetyParameters{}, MotionLimits{}, 1.0, kFeedforward, AutopilotWorld::kItsOwn};
  CommandInputs inputs = inputsAt(atMs(0), Vec3::Zero(), 0.0);
  inputs.recording = true;
  EXPECT_TRUE(commander.step(atMs(0), inputs).verdict.faults.has(Fault::kLive));
  inputs.autopilot.linked = false;
  const FaultSet faults = commander.step(atMs(20), inputs).verdict.faults;
  EXPECT_TRUE(faults.has(Fault::kAutopilot));
  EXPECT_FALSE(faults.has(Fault::kLive));
}

TEST_F(CommanderInFlight, SamplesTheMotionForTheMomentWhenItIsActedOn) {
  ASSERT_EQ(command_.verdict.state, State::kFlying);
  EXPECT_EQ(command_.status, SystemStatus::kActive);
  CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
  now_ += kStep;
  const Command command = commander_.step(now_, inputs);
  ASSERT_TRUE(command.motion);
  const double elapsed_s = toSeconds(now_ + kFeedforward.setpoint_lead - inputs.plan.in_force->stamp);
  const Vec3 expected_W = kHere_W_m + Vec3(4.0 * elapsed_s - 2.0 * elapsed_s * elapsed_s, 0.0, 0.0);
  EXPECT_NEAR((command.target.position_NED_m.cast<double>() - inputs.alignment.T_NED_W->point(expected_W)).norm(), 0.0,
              kTolerance_m);
  const double speed_m_s = 4.0 - 4.0 * elapsed_s;
  EXPECT_NEAR(command.target.velocity_NED_m_s.cast<double>().norm(), speed_m_s, 1e-5);
  // A deceleration of 4 m/s^2, of which the air does its part.
  EXPECT_NEAR(command.target.acceleration_NED_m_s2.cast<double>().norm(), 4.0 - kFeedforward.drag_1_s * speed_m_s,
              1e-5);
}

TEST_F(CommanderInFlight, StalePlanIsFlownToAStandstillAndThenLeft) {
  const CommandInputs last = ordered(inputsAt(now_, kHere_W_m, 4.0));
  const Time began = now_;
  const Vec3 end_W = kHere_W_m + Vec3(2.0, 0.0, 0.0);
  Command command;
  bool sent_at_end = false;
  for (; now_ < began + std::chrono::seconds(5); now_ += kStep) {
    CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 0.0));
    inputs.plan = last.plan;
    inputs.vehicle.state->velocity_W_m_s.x() = 1.0;  // never stands, by the estimator's word
    command = commander_.step(now_, inputs);
    if (!command.motion) break;
    sent_at_end |=
        (command.target.position_NED_m.cast<double>() - last.alignment.T_NED_W->point(end_W)).norm() < 0.01 &&
        command.target.velocity_NED_m_s.norm() < 0.01F;
  }
  EXPECT_TRUE(sent_at_end);
  EXPECT_EQ(command.verdict.state, State::kLost);
  EXPECT_EQ(command.status, SystemStatus::kEmergency);
  EXPECT_LE(now_ - last.plan.in_force->stamp, std::chrono::seconds(1) + SafetyParameters{}.stop_margin + kStep);
}

TEST_F(CommanderInFlight, LostPoseIsBrakedForWithVelocitiesOnly) {
  CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
  now_ += std::chrono::milliseconds(100);
  (void)commander_.step(now_, inputs);
  now_ += std::chrono::milliseconds(150);
  const Command command = commander_.step(now_, inputs);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  ASSERT_TRUE(command.motion);
  EXPECT_EQ(command.target.type_mask & 0b111, 0b111);
  EXPECT_GT(command.target.velocity_NED_m_s.norm(), 2.0F);
}

TEST_F(CommanderInFlight, SilentAutopilotIsBrakedAlongThePlacesThatWereVerified) {
  CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
  now_ += std::chrono::milliseconds(100);
  (void)commander_.step(now_, inputs);
  inputs.alignment.verdict = AlignmentVerdict::kUnknown;  // what was known before is still there
  now_ += kStep;
  Command command = commander_.step(now_, inputs);
  EXPECT_EQ(command.verdict.state, State::kBraking);
  EXPECT_EQ(command.target.type_mask & 0b111, 0);
  inputs.alignment.verdict = AlignmentVerdict::kInconsistent;  // it says something else
  now_ += kStep;
  command = commander_.step(now_, inputs);
  EXPECT_EQ(command.target.type_mask & 0b111, 0b111);
}

TEST_F(CommanderInFlight, SilenceAfterAJumpOfTheAutopilotDoesNotBringTheOldPlacesBack) {
  CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
  (void)commander_.step(now_ += kStep, inputs);
  inputs.alignment.T_NED_W = NedFromWorld(70.0 * kDeg, {105.0, -50.0, -3.0});
  inputs.alignment.verdict = AlignmentVerdict::kInconsistent;
  Command command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  inputs.alignment.verdict = AlignmentVerdict::kUnknown;
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  inputs.vehicle.state->epoch = 1;  // nor does a jump of the estimator, which tells nothing of the autopilot
  inputs.alignment = aligned(NedFromWorld(70.0 * kDeg, {90.0, -50.0, -3.0}), 1);
  inputs.alignment.verdict = AlignmentVerdict::kUnknown;
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  inputs.alignment.verdict = AlignmentVerdict::kGood;  // of the new world: the motion is of the old one
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.state, State::kBraking);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
}

/// It is told the new poses, and takes its world along: the old places are elsewhere in it.
TEST_F(CommanderInFlight, JumpOfAnEstimatorThatTheAutopilotFliesByIsBrakedForWithVelocitiesOnly) {
  commander_ = Commander(SafetyParameters{}, MotionLimits{}, 1.0, kFeedforward, AutopilotWorld::kOurs);
  for (int i = 0; i < 50; ++i, now_ += kStep) (void)commander_.step(now_, inputsAt(now_, kHere_W_m, 0.0));
  CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
  Command command = commander_.step(now_, inputs);
  ASSERT_EQ(command.verdict.stream, Stream::kMotion);
  command = commander_.step(now_ += kStep, inputs);
  inputs.vehicle.state->epoch = 1;  // the poses come first
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.state, State::kBraking);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  inputs.alignment = {};
  inputs.alignment.epoch = 1;
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  inputs.alignment = aligned(NedFromWorld(70.0 * kDeg, {100.0, -50.0, -3.0}), 1);
  command = commander_.step(now_ += kStep, inputs);
  EXPECT_EQ(command.verdict.state, State::kBraking);
  EXPECT_EQ(command.verdict.stream, Stream::kVelocity);
  ASSERT_TRUE(command.motion);
  EXPECT_EQ(command.target.type_mask & 0b111, 0b111);
  EXPECT_GT(command.target.velocity_NED_m_s.norm(), 2.0F);
}

// The estimator's world jumps by tens of metres and 40 degrees; the autopilot's does not.
TEST_F(CommanderInFlight, JumpOfTheEstimatorNeverStepsTheSetpoint) {
  constexpr float kLargestStep_m = 0.15F;  // 4 m/s for a step, and what braking adds
  constexpr double kLargestTurn_rad = 1e-6;
  const NedFromWorld T_NED_W = *inputsAt(now_, kHere_W_m, 0.0).alignment.T_NED_W;
  const NedFromWorld T_NED_Wnew(30.0 * kDeg, {60.0, 20.0, -3.0});
  const Decision before = flying(now_, kHere_W_m, 4.0);
  const Time jump = now_ + std::chrono::milliseconds(100);
  const Time known = jump + std::chrono::milliseconds(1100);
  const Vec3 stands_NED = T_NED_W.point(before.brake.atEnd().position_m);
  const double yaw_Wnew_rad = T_NED_Wnew.heading(T_NED_W.heading(0.0));  // the vehicle goes on looking along old x
  std::optional<LocalNedTarget> last;
  bool new_world_flown = false;
  for (const Time end = now_ + std::chrono::seconds(4); now_ < end; now_ += kStep) {
    CommandInputs inputs = ordered(inputsAt(now_, kHere_W_m, 4.0));
    inputs.plan.in_force = before;
    if (now_ < jump) {
      inputs.plan.in_force->stamp = now_;
    } else {
      const Vec3 here_Wnew = T_NED_Wnew.pointInWorld(stands_NED);
      inputs.vehicle.state->epoch = 1;
      inputs.vehicle.state->T_W_B.translation_m = here_Wnew;
      inputs.vehicle.state->T_W_B.rotation = Quat(Eigen::AngleAxisd(yaw_Wnew_rad, Vec3::UnitZ()));
      inputs.plan.in_force = flying(now_, here_Wnew, 0.0, 1);
      inputs.plan.in_force->yaw_W_rad = yaw_Wnew_rad;
      inputs.alignment = now_ < known ? Alignment{} : aligned(T_NED_Wnew, 1);
      inputs.alignment.epoch = 1;
    }
    const Command command = commander_.step(now_, inputs);
    ASSERT_TRUE(command.motion) << command.verdict.faults.words();
    if (last) {
      EXPECT_LE((command.target.position_NED_m - last->position_NED_m).norm(), kLargestStep_m);
      const auto turn_rad = static_cast<double>(command.target.yaw_NED_rad - last->yaw_NED_rad);
      EXPECT_LE(std::abs(wrapAngle(turn_rad)), kLargestTurn_rad);
    }
    last = command.target;
    new_world_flown |= command.verdict.state == State::kFlying && commander_.inForce()->consumed.epoch == 1;
  }
  EXPECT_TRUE(new_world_flown);
}

}  // namespace
}  // namespace nanomap
