#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/unit/firmware_app/stages/flight_on_a_fake_clock.h"

namespace nanomap {

void PrintTo(State state, std::ostream* out) { *out << toString(state); }

namespace {

using namespace std::chrono_literals;
using test::Broken;
using test::FlightOnAFakeClock;
using test::How;

/// What must come of a fault that lasts.
struct Case {
  Broken what;
  How how;
  std::optional<Duration> braking_within;  ///< empty: it is flown on
  State end;                               ///< after 12 s
};

std::string nameOf(const Case& one) {
  constexpr std::array<const char*, 7> kWhat = {"Depth", "Pose", "Correction", "Mavlink", "Planner", "Sink", "Clock"};
  constexpr std::array<const char*, 8> kHow = {"Off",     "Stuck",        "Late",   "Garbage",
                                               "Jumping", "Intermittent", "Frozen", "Lossy"};
  return std::string(kWhat[static_cast<std::size_t>(one.what)]) + kHow[static_cast<std::size_t>(one.how)];
}

void PrintTo(const Case& one, std::ostream* out) { *out << nameOf(one); }

class FaultMatrix : public ::testing::TestWithParam<Case> {
 protected:
  FaultMatrix() {
    flight_.run(4s);
    EXPECT_EQ(flight_.state(), State::kReady);
    flight_.order();
    flight_.run(3s);
    EXPECT_EQ(flight_.state(), State::kFlying);
    EXPECT_GT(flight_.speed_m_s(), 2.0) << "too slow for the faults to matter";
    flight_.forgetStates();
    began_ = flight_.now();
    first_sent_ = flight_.setpoints().size();
  }

  /// Nothing that was sent is older than it may be, and nothing leaps.
  void expectEverySetpointInOrder() const {
    const SafetyParameters safety;
    const SentSetpoint* last = nullptr;
    for (std::size_t i = first_sent_; i < flight_.setpoints().size(); ++i) {
      const SentSetpoint& sent = flight_.setpoints()[i];
      if (!sent.motion || !sent.motion->decision) continue;
      const MadeDecision* made = flight_.decision(*sent.motion->decision);
      ASSERT_NE(made, nullptr);
      const Trajectory& brake = made->decision.brake;
      const Time end = brake.start() + fromSeconds(brake.duration_s());
      EXPECT_TRUE(sent.stamp - made->decision.stamp <= 200ms || sent.stamp <= end + safety.stop_margin);
      if (last != nullptr && sent.stamp - last->stamp <= 20ms && last->motion->with_position) {
        EXPECT_LE((sent.motion->motion_W.position_m - last->motion->motion_W.position_m).norm(), 0.3);
      }
      last = &sent;
    }
  }

  FlightOnAFakeClock flight_;
  Time began_{};
  std::size_t first_sent_ = 0;
};

TEST_P(FaultMatrix, IsAnsweredAsTheTableSays) {
  const Case& one = GetParam();
  flight_.breakIt(one.what, one.how);
  flight_.run(12s);
  const bool left_flying = flight_.wasIn(State::kBraking) || flight_.wasIn(State::kLost);
  EXPECT_EQ(left_flying, one.braking_within.has_value());
  if (flight_.wasIn(State::kBraking) && one.braking_within) {
    EXPECT_LE(flight_.until(State::kBraking, began_), *one.braking_within);
  }
  EXPECT_EQ(flight_.state(), one.end);
  if (one.end == State::kLost) {
    EXPECT_LT(flight_.speed_m_s(), 0.1);
    EXPECT_EQ(flight_.autopilot.status, SystemStatus::kEmergency);
  }
  expectEverySetpointInOrder();
}

// Limits: the age at which a stream is stale, one sending of it, and one round of the sink.
// A planner's garbage are motions that no vehicle can fly, a sink's are setpoints that the link refuses, as it does
// with what is not finite. Not here: a sink that is off or stuck (below); a clock that is off, which no stamp can come
// from; a sound motion that begins elsewhere, which is not told from one that begins anew where the vehicle is.
const Case kCases[] = {
    {Broken::kDepth, How::kOff, 240ms, State::kLost},
    {Broken::kDepth, How::kStuck, 240ms, State::kLost},
    {Broken::kDepth, How::kFrozen, 240ms, State::kLost},
    {Broken::kDepth, How::kLate, 240ms, State::kLost},
    {Broken::kDepth, How::kGarbage, 240ms, State::kLost},
    {Broken::kDepth, How::kJumping, 240ms, State::kLost},
    {Broken::kDepth, How::kIntermittent, 240ms, State::kLost},
    {Broken::kPose, How::kOff, 240ms, State::kLost},
    {Broken::kPose, How::kStuck, 240ms, State::kLost},
    {Broken::kPose, How::kLate, 240ms, State::kLost},
    {Broken::kPose, How::kGarbage, 240ms, State::kLost},
    {Broken::kPose, How::kJumping, 240ms, State::kLost},
    {Broken::kPose, How::kIntermittent, 240ms, State::kLost},
    {Broken::kCorrection, How::kOff, {}, State::kFlying},
    {Broken::kCorrection, How::kStuck, {}, State::kFlying},
    {Broken::kCorrection, How::kLate, {}, State::kFlying},
    {Broken::kCorrection, How::kGarbage, {}, State::kFlying},
    {Broken::kCorrection, How::kJumping, {}, State::kFlying},
    {Broken::kCorrection, How::kIntermittent, {}, State::kFlying},
    {Broken::kMavlink, How::kOff, 40ms, State::kLost},
    {Broken::kMavlink, How::kStuck, 600ms, State::kLost},
    {Broken::kMavlink, How::kLate, 600ms, State::kLost},
    {Broken::kMavlink, How::kGarbage, 600ms, State::kLost},
    {Broken::kMavlink, How::kJumping, 600ms, State::kLost},
    {Broken::kMavlink, How::kIntermittent, 40ms, State::kLost},
    {Broken::kMavlink, How::kLossy, {}, State::kFlying},
    {Broken::kPlanner, How::kOff, 240ms, State::kLost},
    {Broken::kPlanner, How::kStuck, 240ms, State::kLost},
    {Broken::kPlanner, How::kLate, 240ms, State::kLost},
    {Broken::kPlanner, How::kGarbage, 40ms, State::kLost},
    {Broken::kPlanner, How::kIntermittent, 240ms, State::kLost},
    {Broken::kSink, How::kLate, 640ms, State::kLost},
    {Broken::kSink, How::kGarbage, 240ms, State::kLost},
    {Broken::kSink, How::kIntermittent, 340ms, State::kLost},
    {Broken::kClock, How::kLate, 240ms, State::kLost},
    {Broken::kClock, How::kJumping, 40ms, State::kLost},
};

INSTANTIATE_TEST_SUITE_P(Lasting, FaultMatrix, ::testing::ValuesIn(kCases),
                         [](const auto& parameter) { return nameOf(parameter.param); });

using FlightFaults = FaultMatrix;

TEST_F(FlightFaults, CameraThatIsAwayForASecondIsFlownOutOf) {
  flight_.breakIt(Broken::kDepth, How::kOff);
  flight_.run(1s);
  EXPECT_EQ(flight_.state(), State::kBraking);
  flight_.mend();
  flight_.run(3s);
  EXPECT_EQ(flight_.state(), State::kFlying);
  EXPECT_GT(flight_.speed_m_s(), 1.0);
  EXPECT_FALSE(flight_.wasIn(State::kLost));
  expectEverySetpointInOrder();
}

TEST_F(FlightFaults, FrozenPictureIsNamedAndFlownOutOfWhenItMovesAgain) {
  flight_.breakIt(Broken::kDepth, How::kFrozen);
  flight_.run(1s);
  ASSERT_EQ(flight_.state(), State::kBraking);
  EXPECT_TRUE(flight_.setpoints().back().verdict.faults.has(Fault::kDepthStuck));
  EXPECT_GT(flight_.stuckViews(), 10U);
  flight_.mend();
  flight_.run(3s);
  EXPECT_EQ(flight_.state(), State::kFlying);
  expectEverySetpointInOrder();
}

TEST_F(FlightFaults, FrozenPictureOfAStandingVehicleIsNone) {
  flight_.autopilot.state.external_control = false;
  flight_.run(2s);
  flight_.breakIt(Broken::kDepth, How::kFrozen);
  flight_.run(3s);
  EXPECT_EQ(flight_.state(), State::kReady);
}

class FlightByTheTimeOfDay : public ::testing::TestWithParam<Duration> {
 protected:
  FlightByTheTimeOfDay() {
    flight_.run(4s);
    flight_.order();
    flight_.run(2s);
    EXPECT_EQ(flight_.state(), State::kFlying);
    flight_.forgetStates();
  }

  static Configuration byTheTimeOfDay() {
    Configuration configuration = FlightOnAFakeClock::configuration();
    configuration.lcm.clock = ClockDomain::kRealtime;
    return configuration;
  }

  FlightOnAFakeClock flight_{byTheTimeOfDay()};
};

TEST_P(FlightByTheTimeOfDay, GoesOnWhenItIsSet) {
  flight_.setTimeOfDay(GetParam());
  flight_.run(5s);
  EXPECT_EQ(flight_.state(), State::kFlying);
  EXPECT_FALSE(flight_.wasIn(State::kBraking));
}

TEST_P(FlightByTheTimeOfDay, EndsWithAStreamThatStopsThen) {
  flight_.setTimeOfDay(GetParam());
  flight_.breakIt(Broken::kPose, How::kStuck);
  flight_.run(8s);
  EXPECT_EQ(flight_.state(), State::kLost);
}

INSTANTIATE_TEST_SUITE_P(FlightFaults, FlightByTheTimeOfDay, ::testing::Values(50ms, 3600s, -50ms, -3600s));

TEST_F(FlightFaults, SinkThatIsOffSendsNothing) {
  const std::uint64_t sent = flight_.autopilot.targets;
  flight_.breakIt(Broken::kSink, How::kOff);
  flight_.run(2s);
  EXPECT_EQ(flight_.autopilot.targets, sent);
  EXPECT_EQ(flight_.speed_m_s(), 0.0);
}

TEST_F(FlightFaults, StoppedProcessGoesOnWithNothingOld) {
  const std::uint64_t sent = flight_.autopilot.targets;
  flight_.stopProcess(5s);
  const Time resumed = flight_.now();
  flight_.run(2s);
  EXPECT_EQ(flight_.state(), State::kLost);
  EXPECT_EQ(flight_.autopilot.targets, sent) << "told something after " << toSeconds(resumed - began_) << " s";
}

TEST_F(FlightFaults, LostVehicleIsFlownAgainAfterAFreshSwitchOnly) {
  flight_.breakIt(Broken::kPlanner, How::kOff);
  flight_.run(5s);
  ASSERT_EQ(flight_.state(), State::kLost);
  flight_.mend();
  flight_.run(3s);
  EXPECT_EQ(flight_.state(), State::kLost);
  flight_.autopilot.state.external_control = false;
  flight_.run(1s);
  EXPECT_EQ(flight_.state(), State::kReady);
  flight_.order();
  flight_.run(1s);
  EXPECT_EQ(flight_.state(), State::kFlying);
}

TEST_F(FlightFaults, PilotIsObeyedWithinOneRound) {
  flight_.autopilot.state.external_control = false;
  flight_.run(40ms);
  EXPECT_EQ(flight_.state(), State::kReady);
  ASSERT_TRUE(flight_.setpoints().back().motion);
  EXPECT_FALSE(flight_.setpoints().back().motion->decision) << "only a hold is streamed";
}

}  // namespace
}  // namespace nanomap
