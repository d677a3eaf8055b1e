#include "firmware_app/safety/state_machine.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "tests/unit/firmware_app/safety/healthy.h"

namespace nanomap {

void PrintTo(State state, std::ostream* out) { *out << toString(state); }
void PrintTo(Stream stream, std::ostream* out) { *out << toString(stream); }

namespace {

constexpr Duration kSecond = std::chrono::seconds(1);

/// A state machine with a clock of its own.
class Machine {
 public:
  using Change = std::function<void(Situation&)>;

  /// Steps through `duration`, every situation changed by `change`; the last verdict.
  SafetyVerdict run(Duration duration, const Change& change) {
    for (const Time end = now_ + duration; now_ < end;) verdict_ = step(change);
    return verdict_;
  }

  SafetyVerdict step(const Change& change) {
    now_ += kStep;
    Situation situation = healthyAt(now_);
    change(situation);
    verdict_ = machine_.step(situation);
    states_.try_emplace(verdict_.state, now_);
    return verdict_;
  }

  /// As it is after the pilot has switched to us.
  void fly() {
    run(kSecond, [](Situation&) {});
    ASSERT_EQ(run(kStep, ordered).state, State::kFlying);
    states_.clear();
    began_ = now_;
  }

  /// How long after fly() the state was first seen.
  [[nodiscard]] Duration until(State state) const { return states_.at(state) - began_; }
  [[nodiscard]] bool wasIn(State state) const { return states_.contains(state); }
  [[nodiscard]] Time now() const { return now_; }

  static void ordered(Situation& situation) {
    situation.external_control = true;
    situation.external_control_entries = 1;
  }

 private:
  StateMachine machine_{SafetyParameters{}};
  Time now_ = atMs(1'000'000);
  Time began_{};
  SafetyVerdict verdict_;
  std::map<State, Time> states_;
};

TEST(StateMachine, BeginsWaitingAndSendsNothing) {
  StateMachine machine{SafetyParameters{}};
  Situation nothing;
  nothing.now = atMs(0);
  const SafetyVerdict verdict = machine.step(nothing);
  EXPECT_EQ(verdict.state, State::kWaiting);
  EXPECT_EQ(verdict.stream, Stream::kNone);
  EXPECT_EQ(verdict.faults.words(), "camera model, depth images, poses, a plan, autopilot, alignment");
}

TEST(StateMachine, IsReadyOnceNothingIsMissingForAWhile) {
  Machine machine;
  machine.step([](Situation& s) { s.depth.reset(); });
  EXPECT_EQ(machine.run(std::chrono::milliseconds(480), [](Situation&) {}).state, State::kWaiting);
  const SafetyVerdict verdict = machine.run(std::chrono::milliseconds(40), [](Situation&) {});
  EXPECT_EQ(verdict.state, State::kReady);
  EXPECT_EQ(verdict.stream, Stream::kHold);
}

TEST(StateMachine, FliesOnlyAfterASwitchThatItHasSeen) {
  Machine machine;
  const auto in_offboard_from_the_first = [](Situation& s) { s.external_control = true; };
  const SafetyVerdict from_the_first = machine.run(5 * kSecond, in_offboard_from_the_first);
  EXPECT_EQ(from_the_first.state, State::kReady);
  EXPECT_TRUE(from_the_first.old_switch);
  EXPECT_FALSE(machine.run(kSecond, [](Situation&) {}).old_switch);
  const SafetyVerdict switched = machine.step(Machine::ordered);
  EXPECT_EQ(switched.state, State::kFlying);
  EXPECT_FALSE(switched.old_switch);
}

TEST(StateMachine, SwitchBeforeItWasReadyIsNoOrder) {
  Machine machine;
  machine.run(kSecond, [](Situation& s) {
    Machine::ordered(s);
    s.plan.reset();
  });
  EXPECT_EQ(machine.run(5 * kSecond, Machine::ordered).state, State::kReady);
  const auto again = [](Situation& s) {
    s.external_control = true;
    s.external_control_entries = 2;
  };
  EXPECT_EQ(machine.step(again).state, State::kFlying);
}

TEST(StateMachine, OrderOnTheGroundWaitsForArming) {
  Machine machine;
  machine.run(kSecond, [](Situation&) {});
  const auto disarmed = [](Situation& s) {
    Machine::ordered(s);
    s.armed = false;
  };
  const SafetyVerdict verdict = machine.run(5 * kSecond, disarmed);
  EXPECT_EQ(verdict.state, State::kReady);
  EXPECT_EQ(verdict.stream, Stream::kHold);
  EXPECT_FALSE(verdict.old_switch);
  EXPECT_EQ(machine.step(Machine::ordered).state, State::kFlying);
}

TEST(StateMachine, OrderIsForgottenWhenThePilotLeavesBeforeArming) {
  Machine machine;
  machine.run(kSecond, [](Situation&) {});
  machine.step([](Situation& s) {
    Machine::ordered(s);
    s.armed = false;
  });
  machine.step([](Situation& s) { s.external_control_entries = 1; });
  EXPECT_EQ(machine.run(kSecond, Machine::ordered).state, State::kReady);
}

TEST(StateMachine, LeavesTheVehicleToThePilotAtOnce) {
  Machine machine;
  machine.fly();
  const SafetyVerdict verdict = machine.step([](Situation& s) { s.external_control_entries = 1; });
  EXPECT_EQ(verdict.state, State::kReady);
  EXPECT_EQ(verdict.stream, Stream::kHold);
  EXPECT_EQ(machine.run(kSecond, [](Situation& s) { s.external_control_entries = 1; }).state, State::kReady);
}

TEST(StateMachine, DisarmingInFlightEndsIt) {
  Machine machine;
  machine.fly();
  const auto disarmed = [](Situation& s) {
    Machine::ordered(s);
    s.armed = false;
  };
  EXPECT_EQ(machine.step(disarmed).state, State::kReady);
  EXPECT_EQ(machine.run(kSecond, Machine::ordered).state, State::kReady);
}

TEST(StateMachine, BrakingIsTakenFromUsByThePilotToo) {
  Machine machine;
  machine.fly();
  EXPECT_EQ(machine
                .step([](Situation& s) {
                  Machine::ordered(s);
                  s.depth.reset();
                })
                .state,
            State::kBraking);
  const SafetyVerdict verdict = machine.step([](Situation& s) { s.depth.reset(); });
  EXPECT_EQ(verdict.state, State::kWaiting);
  EXPECT_EQ(verdict.stream, Stream::kNone);
}

TEST(StateMachine, BriefFaultIsFlownOutOfOnceItHasSettled) {
  Machine machine;
  machine.fly();
  machine.run(std::chrono::milliseconds(300), [](Situation& s) {
    Machine::ordered(s);
    s.pose = s.now - kSecond;
  });
  EXPECT_EQ(machine.run(std::chrono::milliseconds(480), Machine::ordered).state, State::kBraking);
  EXPECT_EQ(machine.run(std::chrono::milliseconds(40), Machine::ordered).state, State::kFlying);
  EXPECT_FALSE(machine.wasIn(State::kLost));
}

/// Who took over and gave back meanwhile was not seen.
TEST(StateMachine, OrderFromBeforeALinkWasDownIsNone) {
  Machine machine;
  machine.fly();
  const auto unheard = [](Situation& s) {
    Machine::ordered(s);
    s.linked = false;
  };
  EXPECT_EQ(machine.step(unheard).state, State::kBraking);
  EXPECT_EQ(machine.run(std::chrono::milliseconds(480), Machine::ordered).state, State::kBraking);
  const SafetyVerdict verdict = machine.run(std::chrono::milliseconds(40), Machine::ordered);
  EXPECT_EQ(verdict.state, State::kReady);
  EXPECT_EQ(verdict.stream, Stream::kHold);
  EXPECT_TRUE(verdict.old_switch);
  EXPECT_EQ(machine.run(kSecond, Machine::ordered).state, State::kReady);
}

TEST(StateMachine, LostStaysLostUntilThePilotTakesOver) {
  Machine machine;
  machine.fly();
  const Time last_plan = machine.now();
  const auto without_plan = [last_plan](Situation& s) {
    Machine::ordered(s);
    s.plan = last_plan;
    s.brake_end = last_plan + kSecond;
  };
  EXPECT_EQ(machine.run(10 * kSecond, without_plan).state, State::kLost);
  EXPECT_EQ(machine.run(10 * kSecond, Machine::ordered).state, State::kLost);
  EXPECT_EQ(machine.step([](Situation& s) { s.external_control_entries = 1; }).state, State::kReady);
}

TEST(StateMachine, VehicleThatStandsIsLetGoAfterPatienceAndNotBefore) {
  Machine machine;
  machine.fly();
  const Time last_plan = machine.now();
  machine.run(10 * kSecond, [last_plan](Situation& s) {
    Machine::ordered(s);
    s.depth = last_plan;
    s.brake_end = last_plan + kSecond;
    s.speed_m_s = 0.1;
  });
  const SafetyParameters parameters;
  EXPECT_GE(machine.until(State::kLost), parameters.max_depth_age + parameters.patience);
  EXPECT_LE(machine.until(State::kLost), parameters.max_depth_age + parameters.patience + 2 * kStep);
}

TEST(StateMachine, BrakeIsNeverFlownBeyondItsTimeAndTheMargin) {
  Machine machine;
  machine.fly();
  const Time last_plan = machine.now();
  const Duration brake = std::chrono::milliseconds(1400);
  machine.run(10 * kSecond, [=](Situation& s) {
    Machine::ordered(s);
    s.plan = last_plan;
    s.brake_end = last_plan + brake;  // and the vehicle does not stop
  });
  EXPECT_EQ(machine.until(State::kLost), brake + SafetyParameters{}.stop_margin);
}

TEST(StateMachine, StoppedProcessDoesNotGoOnWithAnOldMotion) {
  StateMachine machine{SafetyParameters{}};
  Time now = atMs(0);
  for (int i = 0; i < 50; ++i, now += kStep) (void)machine.step(healthyAt(now));
  ASSERT_EQ(machine.step(orderedAt(now)).state, State::kFlying);
  Situation resumed = orderedAt(now);
  resumed.now = now + 10 * kSecond;
  const SafetyVerdict verdict = machine.step(resumed);
  EXPECT_EQ(verdict.state, State::kLost);
  EXPECT_EQ(verdict.stream, Stream::kNone);
  EXPECT_TRUE(verdict.faults.has(Fault::kHeldUp));
}

TEST(StateMachine, ShortPauseWithFreshDataBrakesWithinThePlannedTime) {
  StateMachine machine{SafetyParameters{}};
  Time now = atMs(0);
  for (int i = 0; i < 50; ++i, now += kStep) (void)machine.step(healthyAt(now));
  ASSERT_EQ(machine.step(orderedAt(now)).state, State::kFlying);
  const SafetyVerdict verdict = machine.step(orderedAt(now + std::chrono::milliseconds(201)));
  EXPECT_EQ(verdict.state, State::kBraking);
  EXPECT_EQ(verdict.stream, Stream::kMotion);
}

// What is broken, and how the vehicle is braked and let go: the fault matrix as far as ages and verdicts show it.
struct FaultCase {
  std::string name;
  std::function<void(Situation&, Time began)> break_it;
  Fault fault;
  Duration until_braking;
  Stream stream;
};

void PrintTo(const FaultCase& fault, std::ostream* out) { *out << fault.name; }

class StateMachineFaults : public ::testing::TestWithParam<FaultCase> {};

TEST_P(StateMachineFaults, AreBrakedForInTimeAndThenLetGo) {
  const FaultCase& fault = GetParam();
  Machine machine;
  machine.fly();
  const Time began = machine.now();
  const auto broken = [&](Situation& s) {
    Machine::ordered(s);
    s.brake_end = began + kSecond;
    fault.break_it(s, began);
  };
  machine.run(fault.until_braking + kStep, broken);
  ASSERT_TRUE(machine.wasIn(State::kBraking));
  EXPECT_LE(machine.until(State::kBraking), fault.until_braking + kStep);
  if (fault.until_braking > kStep) {
    EXPECT_GT(machine.until(State::kBraking), fault.until_braking - kStep);
  }

  const SafetyVerdict braking = machine.step(broken);
  EXPECT_EQ(braking.state, State::kBraking);
  EXPECT_EQ(braking.stream, fault.stream);
  EXPECT_TRUE(braking.faults.has(fault.fault)) << braking.faults.words();
  EXPECT_FALSE(braking.critical);
  EXPECT_TRUE(machine.run(std::chrono::milliseconds(500), broken).critical);

  const SafetyVerdict lost = machine.run(5 * kSecond, broken);
  EXPECT_EQ(lost.state, State::kLost);
  EXPECT_EQ(lost.stream, Stream::kNone);
  EXPECT_EQ(machine.until(State::kLost), kSecond + SafetyParameters{}.stop_margin);
}

constexpr Duration kAtOnce = kStep;

const FaultCase kFaultCases[] = {
    {"DepthOff", [](Situation& s, Time began) { s.depth = began; }, Fault::kDepth, std::chrono::milliseconds(200),
     Stream::kMotion},
    {"DepthLate", [](Situation& s, Time) { s.depth = s.now - kSecond; }, Fault::kDepth, kAtOnce, Stream::kMotion},
    {"DepthOfAnotherClock", [](Situation& s, Time) { s.depth = s.now + kSecond; }, Fault::kClock, kAtOnce,
     Stream::kMotion},
    {"DepthStuck", [](Situation& s, Time) { s.depth_stuck = true; }, Fault::kDepthStuck, kAtOnce, Stream::kMotion},
    {"SetpointsRefused", [](Situation& s, Time began) { s.unsent_since = began; }, Fault::kUnsent,
     std::chrono::milliseconds(200), Stream::kMotion},
    {"PoseOff", [](Situation& s, Time began) { s.pose = began; }, Fault::kPose, std::chrono::milliseconds(200),
     Stream::kVelocity},
    {"PoseLate", [](Situation& s, Time) { s.pose = s.now - kSecond; }, Fault::kPose, kAtOnce, Stream::kVelocity},
    {"PoseOfAnotherClock", [](Situation& s, Time) { s.pose = s.now + kSecond; }, Fault::kClock, kAtOnce,
     Stream::kMotion},
    {"PlannerOff", [](Situation& s, Time began) { s.plan = began; }, Fault::kPlan, std::chrono::milliseconds(150),
     Stream::kMotion},
    {"PlannerLate", [](Situation& s, Time) { s.plan = s.now - kSecond; }, Fault::kPlan, kAtOnce, Stream::kMotion},
    {"ToldToEnd", [](Situation& s, Time) { s.ending = true; }, Fault::kEnding, kAtOnce, Stream::kMotion},
    {"ThreadStalled", [](Situation& s, Time) { s.stalled = true; }, Fault::kStalled, kAtOnce, Stream::kMotion},
    {"AutopilotGone", [](Situation& s, Time) { s.linked = false; }, Fault::kAutopilot, kAtOnce, Stream::kMotion},
    {"EstimatorJumped", [](Situation& s, Time) { s.anchored = false; }, Fault::kAlignment, kAtOnce, Stream::kMotion},
    {"AutopilotJumped",
     [](Situation& s, Time) {
       s.anchored = false;
       s.motion_anchored = false;
     },
     Fault::kAlignment, kAtOnce, Stream::kVelocity},
};

INSTANTIATE_TEST_SUITE_P(Matrix, StateMachineFaults, ::testing::ValuesIn(kFaultCases),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(StateMachine, IntermittentFaultNeverFliesOn) {
  Machine machine;
  machine.fly();
  for (int i = 0; i < 20; ++i) {
    const SafetyVerdict braking = machine.run(std::chrono::milliseconds(100), [](Situation& s) {
      Machine::ordered(s);
      s.depth = s.now - kSecond;
    });
    EXPECT_NE(braking.state, State::kFlying);
    EXPECT_NE(machine.run(std::chrono::milliseconds(300), Machine::ordered).state, State::kFlying);
  }
}

TEST(StateMachine, AgeAtItsLimitIsNoFault) {
  StateMachine machine{SafetyParameters{}};
  Situation situation = healthyAt(atMs(1000));
  situation.depth = situation.now - SafetyParameters{}.max_depth_age;
  EXPECT_FALSE(machine.step(situation).faults.any());
  situation.now += Duration(1);
  EXPECT_TRUE(machine.step(situation).faults.has(Fault::kDepth));
}

TEST(SafetyParameters, WarningComesBeforeLettingGo) {
  SafetyParameters parameters;
  EXPECT_NO_THROW(check(parameters));
  parameters.patience = parameters.critical_after - Duration(1);
  EXPECT_THROW(check(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace nanomap
