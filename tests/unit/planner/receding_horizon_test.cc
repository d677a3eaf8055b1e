#include "planner/receding_horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/brake.h"
#include "planner/primitive_library.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::DrawnWorld;
using test::Flight;
using test::goalAt;

constexpr Duration kPeriod = std::chrono::milliseconds(30);

/// Over an empty field; the vehicle is wherever a test says it is.
class RecedingHorizonOverAField : public testing::Test {
 protected:
  RecedingHorizonOverAField() { flight_.look(); }

  Decision step(const VehicleState& measured, Time now) {
    return horizon_.step(flight_.snapshot(), measured, goal_, now);
  }

  [[nodiscard]] VehicleState measuredAt(Time stamp, const Motion& motion) const {
    VehicleState state = flight_.state();
    state.stamp = stamp;
    state.T_W_B.translation_m = motion.position_m;
    state.velocity_W_m_s = motion.velocity_m_s;
    state.acceleration_W_m_s2 = motion.acceleration_m_s2;
    return state;
  }

  Flight flight_{DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0};
  RecedingHorizon horizon_{test::flightParameters()};
  Goal goal_ = goalAt({50.0, 0.0, 2.0});
};

TEST_F(RecedingHorizonOverAField, BeforeTheFirstPlanNothingIsInForce) {
  EXPECT_FALSE(horizon_.inForce());
  EXPECT_FALSE(horizon_.motionAt(flight_.now()));
  EXPECT_EQ(horizon_.startState(flight_.state(), flight_.now()).T_W_B.translation_m,
            flight_.state().T_W_B.translation_m);
}

TEST_F(RecedingHorizonOverAField, AVehicleThatLagsIsPlannedForOnTheMotionInForce) {
  const Time start = flight_.now();
  const Decision first = step(flight_.state(), start);
  ASSERT_EQ(first.reason, Reason::kFlying);
  const Time now = start + kPeriod;
  Motion lagging = *horizon_.motionAt(now);
  lagging.position_m.x() -= 0.2;
  lagging.acceleration_m_s2.setZero();
  const Decision second = step(measuredAt(now, lagging), now);

  const Motion told = first.brake.sample(now);
  EXPECT_EQ(second.trajectory.atStart().position_m, told.position_m);
  EXPECT_EQ(second.trajectory.atStart().velocity_m_s, told.velocity_m_s);
  EXPECT_EQ(second.trajectory.atStart().acceleration_m_s2, told.acceleration_m_s2) << "setpoints have no step";
}

TEST_F(RecedingHorizonOverAField, AVehicleBesideTheMotionInForceIsJudgedWhereItIsUntilItIsBack) {
  const Time start = flight_.now();
  (void)step(flight_.state(), start);
  const Time now = start + kPeriod;
  const Vec3 aside_m(-0.2, 0.3, 0.1);
  Motion beside = *horizon_.motionAt(now);
  beside.position_m += aside_m;
  const Explanation explained = horizon_.explain(flight_.snapshot(), measuredAt(now, beside), goal_, now);

  const double recovery_s = TrackingTolerance{}.recovery_s;
  int before = 0;
  int after = 0;
  for (const CandidateExplanation& candidate : explained.candidates) {
    const auto expectBeside = [&](const Trajectory& told, const std::vector<SampleEvidence>& evidence) {
      for (const SampleEvidence& sample : evidence) {
        const double left = std::max(0.0, 1.0 - sample.elapsed_s / recovery_s);
        const Vec3 expected_m = told.sample(sample.elapsed_s).position_m + left * aside_m;
        EXPECT_TRUE(sample.position_W_m.isApprox(expected_m, 1e-9)) << sample.position_W_m.transpose();
        ++(left > 0.0 ? before : after);
      }
    };
    expectBeside(candidate.trajectory, candidate.evidence.motion);
    expectBeside(candidate.brake, candidate.evidence.brake);
  }
  EXPECT_GT(before, 1000);
  EXPECT_GT(after, 0) << "brakes are followed until it is back";
}

TEST_F(RecedingHorizonOverAField, AMeasurementThatIsOlderThanThePlanIsNotBesideTheMotion) {
  const Time start = flight_.now();
  Motion fast{{0.0, 0.0, 2.0}, {5.0, 0.0, 0.0}, Vec3::Zero()};
  ASSERT_EQ(step(measuredAt(start, fast), start).reason, Reason::kFlying);
  const Time stamp = start + kPeriod;
  const Time now = stamp + 2 * kPeriod;
  const VehicleState follows = measuredAt(stamp, *horizon_.motionAt(stamp));
  const Explanation explained = horizon_.explain(flight_.snapshot(), follows, goal_, now);
  const SampleEvidence& first = explained.candidates.front().evidence.motion.front();
  EXPECT_TRUE(first.position_W_m.isApprox(horizon_.motionAt(now)->position_m, 1e-9));
}

/// A state that comes late belongs to what was flown before, of which the motion in force is the continuation.
TEST_F(RecedingHorizonOverAField, AMeasurementFromBeforeTheMotionInForceIsNotBesideIt) {
  const Motion fast{{0.0, 0.0, 2.0}, {5.0, 0.0, 0.0}, Vec3::Zero()};
  const Time start = flight_.now();
  ASSERT_EQ(step(measuredAt(start, fast), start).reason, Reason::kFlying);
  const Time stamp = start - 2 * kPeriod;
  Motion before = fast;
  before.position_m.x() -= 5.0 * toSeconds(2 * kPeriod);
  const Explanation explained = horizon_.explain(flight_.snapshot(), measuredAt(stamp, before), goal_, start);
  const SampleEvidence& first = explained.candidates.front().evidence.motion.front();
  EXPECT_TRUE(first.position_W_m.isApprox(fast.position_m, 1e-9)) << first.position_W_m.transpose();
}

/// A vehicle is told to hover at the origin, and is `aside_m` beside that when it sees a wall.
class RecedingHorizonBesideItsHover : public testing::Test {
 protected:
  static Decision stepWith(double aside_m, double wall_m) {
    RecedingHorizon horizon(test::flightParameters());
    Flight field(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0);
    field.look();
    const Decision hover = horizon.step(field.snapshot(), field.state(), std::nullopt, field.now());
    EXPECT_TRUE(isFlyable(hover));
    Flight wall(DrawnWorld{{test::Block{{wall_m, -40.0, 0.0}, {wall_m + 1.0, 40.0, 20.0}}}}, {aside_m, 0.0, 2.0}, 0.0);
    wall.look();
    return horizon.step(wall.snapshot(), wall.state(), std::nullopt, wall.now());
  }
};

TEST_F(RecedingHorizonBesideItsHover, StandsWhereBothPlacesAreClear) {
  const Decision decision = stepWith(-0.4, 1.5);
  EXPECT_EQ(decision.trajectory.atStart().position_m, Vec3(0.0, 0.0, 2.0)) << "told from where it should be";
  EXPECT_EQ(decision.reason, Reason::kNoGoal);
  EXPECT_EQ(stepWith(0.4, 1.5).reason, Reason::kNoGoal);
}

TEST_F(RecedingHorizonBesideItsHover, DoesNotStandWhereItIsTooNear) {
  EXPECT_NE(stepWith(0.4, 0.9).reason, Reason::kNoGoal);
  EXPECT_EQ(stepWith(0.0, 0.9).reason, Reason::kNoGoal);
}

/// Its brake is over before it is back.
TEST_F(RecedingHorizonBesideItsHover, DoesNotComeBackToAPlaceThatIsTooNear) {
  EXPECT_NE(stepWith(-0.45, 0.35).reason, Reason::kNoGoal);
}

TEST(Aside, IsLeftBehindEvenlyAndLeavesSomeDoubt) {
  const Aside aside{{0.4, -0.2, 0.0}, 2.0};
  EXPECT_EQ(aside.at(0.0), Vec3(0.4, -0.2, 0.0));
  EXPECT_EQ(aside.deviation(0.0), Vec3::Zero());
  EXPECT_TRUE(aside.at(0.5).isApprox(Vec3(0.3, -0.15, 0.0)));
  EXPECT_TRUE(aside.deviation(0.5).isApprox(Vec3(0.025, -0.0125, 0.0)));
  EXPECT_FALSE(aside.isBackAt(1.99));
  for (const double elapsed_s : {2.0, 9.0}) {
    EXPECT_TRUE(aside.isBackAt(elapsed_s));
    EXPECT_EQ(aside.at(elapsed_s), Vec3::Zero());
    EXPECT_TRUE(aside.deviation(elapsed_s).isApprox(Vec3(0.1, -0.05, 0.0)));
  }
}

TEST(Aside, IsNoneWithoutARecovery) {
  const Aside none{{0.4, -0.2, 0.0}, 0.0};
  EXPECT_EQ(none.at(0.0), Vec3::Zero());
  EXPECT_EQ(none.deviation(0.0), Vec3::Zero());
  EXPECT_TRUE(none.isBackAt(0.0));
}

TEST_F(RecedingHorizonOverAField, AVehicleThatIsElsewhereIsPlannedForAsMeasured) {
  const Time now = flight_.now() + kPeriod;
  (void)step(flight_.state(), flight_.now());
  const TrackingTolerance tolerance;
  for (const Vec3& error_m : {Vec3(tolerance.max_position_error_m + 0.01, 0.0, 0.0), Vec3(0.0, 0.0, -3.0)}) {
    Motion away = *horizon_.motionAt(now);
    away.position_m += error_m;
    EXPECT_EQ(horizon_.startState(measuredAt(now, away), now).T_W_B.translation_m, away.position_m);
  }
  Motion faster = *horizon_.motionAt(now);
  faster.velocity_m_s.y() += tolerance.max_velocity_error_m_s + 0.01;
  EXPECT_EQ(horizon_.startState(measuredAt(now, faster), now).velocity_W_m_s, faster.velocity_m_s);
}

TEST_F(RecedingHorizonOverAField, WhatIsWrongWithAStateStaysVisible) {
  (void)step(flight_.state(), flight_.now());
  const Time now = flight_.now() + kPeriod;
  VehicleState state = measuredAt(now, *horizon_.motionAt(now));

  VehicleState invalid = state;
  invalid.velocity_W_m_s.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(step(invalid, now).reason, Reason::kStateInvalid);
  VehicleState old = state;
  old.stamp = now - std::chrono::milliseconds(201);
  EXPECT_EQ(step(old, now).reason, Reason::kStateOtherTime);
  VehicleState from_the_future = state;
  from_the_future.stamp = now + kPeriod;
  EXPECT_EQ(step(from_the_future, now).reason, Reason::kStateOtherTime);
  VehicleState other_world = state;
  ++other_world.epoch;
  EXPECT_EQ(horizon_.startState(other_world, now).T_W_B.translation_m, other_world.T_W_B.translation_m);
  EXPECT_EQ(horizon_.inForce()->stamp, flight_.now()) << "none of these plans is flown";
}

TEST_F(RecedingHorizonOverAField, WhatIsLeftOfTheMotionInForceIsACandidateWhileItIsFollowed) {
  const Time start = flight_.now();
  const Time now = start + kPeriod;
  const auto candidatesAfter = [&](auto&& disturb) {
    horizon_.release();
    EXPECT_EQ(step(flight_.state(), start).candidates, kCandidateCount) << "nothing is in force";
    VehicleState state = measuredAt(now, *horizon_.motionAt(now));
    Time planned_for = now;
    disturb(state, planned_for);
    return horizon_.explain(flight_.snapshot(), state, goal_, planned_for).decision.candidates;
  };
  EXPECT_EQ(candidatesAfter([](VehicleState&, Time&) {}), kMostCandidates);
  EXPECT_EQ(candidatesAfter([](VehicleState& state, Time&) { state.T_W_B.translation_m.y() += 1.0; }), kCandidateCount);
  EXPECT_EQ(candidatesAfter([&](VehicleState& state, Time& planned_for) {
              planned_for = start - kPeriod;
              state.stamp = planned_for;
            }),
            kCandidateCount)
      << "from before it began";
  EXPECT_EQ(candidatesAfter([this](VehicleState&, Time&) { horizon_.release(); }), kCandidateCount);

  PlannerParameters papers = test::flightParameters();
  papers.stop_check = StopCheck::kPaper;
  RecedingHorizon by_paper(papers);
  (void)by_paper.step(flight_.snapshot(), flight_.state(), goal_, start);
  EXPECT_EQ(
      by_paper.explain(flight_.snapshot(), measuredAt(now, *by_paper.motionAt(now)), goal_, now).decision.candidates,
      kCandidateCount);
}

/// Else its shorter and shorter rest would be the better stop, and it would neither look around nor move away.
TEST(RecedingHorizon, AVehicleThatStandsKeepsToNothing) {
  int standing = 0;
  for (double distance_m = 0.56; distance_m < 0.8; distance_m += 0.02) {
    Flight flight(DrawnWorld{{test::Block{{6.0, -20.0, 0.0}, {7.0, 20.0, 12.0}}}}, {6.0 - distance_m, 0.0, 2.0}, 0.0);
    for (const Decision& decision : flight.fly(goalAt({50.0, 0.0, 2.0}), 1.5)) {
      if (decision.trajectory.atStart().velocity_m_s.norm() > 0.01) continue;
      ++standing;
      EXPECT_NE(decision.reason, Reason::kKeeping) << distance_m;
    }
  }
  EXPECT_GT(standing, 100);
}

TEST_F(RecedingHorizonOverAField, WithoutANewPlanItStandsStillInTheEnd) {
  (void)step(flight_.state(), flight_.now());
  const Motion end = *horizon_.motionAt(flight_.now() + std::chrono::seconds(20));
  EXPECT_LT(end.velocity_m_s.norm(), 1e-9);
  EXPECT_EQ(end.position_m, horizon_.inForce()->brake.atEnd().position_m);
}

/// At the edge of the tolerance a goal moves in and out of it, as it is corrected for drift.
TEST_F(RecedingHorizonOverAField, AGoalThatMovesALittleIsArrivedAtOnce) {
  Time now = flight_.now();
  const auto reasonWithGoalAt = [&](double x_m) {
    goal_ = goalAt({x_m, 0.0, 2.0});
    now += kPeriod;
    return step(measuredAt(now, {{0.0, 0.0, 2.0}, Vec3::Zero(), Vec3::Zero()}), now).reason;
  };
  EXPECT_EQ(reasonWithGoalAt(0.6), Reason::kFlying);
  horizon_.release();
  EXPECT_EQ(reasonWithGoalAt(0.4), Reason::kAtGoal);
  EXPECT_EQ(reasonWithGoalAt(0.6), Reason::kAtGoal);
  EXPECT_EQ(horizon_.explain(flight_.snapshot(), flight_.state(), goal_, flight_.now()).decision.reason,
            Reason::kAtGoal);
  EXPECT_EQ(reasonWithGoalAt(0.4), Reason::kAtGoal);
  EXPECT_EQ(reasonWithGoalAt(1.0), Reason::kFlying);
  horizon_.release();
  EXPECT_EQ(reasonWithGoalAt(0.6), Reason::kFlying) << "whoever has had the vehicle since may have moved it";
}

TEST_F(RecedingHorizonOverAField, ExplainingTakesNothingIntoForce) {
  const Explanation explanation = horizon_.explain(flight_.snapshot(), flight_.state(), goal_, flight_.now());
  EXPECT_EQ(explanation.decision.reason, Reason::kFlying);
  EXPECT_FALSE(horizon_.inForce());
}

/// A brake that was verified ends where it was verified to, whatever brakes that begin anew would do. Once it stands, the
/// vehicle looks for a way round the wall, and away from it where it is too near, which is another matter.
TEST(RecedingHorizon, TowardsAWallEveryPlanIsVerified) {
  int kept = 0;
  for (const double distance_m : {6.0, 8.0, 10.0, 12.0}) {
    Flight flight(DrawnWorld{{test::Block{{distance_m, -40.0, 0.0}, {distance_m + 1.0, 40.0, 20.0}}}}, {0.0, 0.0, 2.0},
                  0.0);
    for (const Decision& decision : flight.fly(goalAt({50.0, 0.0, 2.0}, 8.0), 5.0)) {
      EXPECT_TRUE(decision.brake_verified) << distance_m << " m: " << toString(decision.reason);
      kept += decision.reason == Reason::kKeeping;
    }
    EXPECT_LT(flight.motion().velocity_m_s.norm(), 0.5) << distance_m;
    EXPECT_GT(flight.leastClearance_m(), 0.4) << distance_m;
  }
  EXPECT_GT(kept, 0);
}

/// On its way to a stop before a wall, where a brake that begins anew has to bring its acceleration up once more.
class RecedingHorizonHalfwayThroughABrake : public testing::Test {
 protected:
  /// @param left_m  from where the brake in force ends to the wall
  Decision planWith(double left_m, bool keeps_it) {
    const Vec3 here_m(0.0, 0.0, 2.0);
    const Motion fast{here_m, {6.0, 0.0, 0.0}, Vec3::Zero()};
    const Trajectory whole = brakeAfter(Trajectory(kNow - 5 * kPeriod, fast), 0.0, MotionLimits());
    Motion start = fast;
    start.position_m += here_m - whole.sample(kNow).position_m;
    brake_ = brakeAfter(Trajectory(whole.start(), start), 0.0, MotionLimits());

    const double face_m = brake_.atEnd().position_m.x() + left_m;
    Flight flight(DrawnWorld{{test::Block{{face_m, -40.0, 0.0}, {face_m + 1.0, 40.0, 20.0}}}}, here_m, 0.0);
    flight.look();
    EXPECT_EQ(flight.now(), kNow);
    const Motion motion = brake_.sample(kNow);
    VehicleState state = flight.state();
    state.T_W_B.translation_m = motion.position_m;
    state.velocity_W_m_s = motion.velocity_m_s;
    state.acceleration_W_m_s2 = motion.acceleration_m_s2;
    const Trajectory rest = brake_.rest(kNow);
    return flight.planner().plan(flight.snapshot(), state, goalAt({50.0, 0.0, 2.0}, 8.0), kNow,
                                 {.rest = keeps_it ? &rest : nullptr});
  }

  static constexpr Time kNow = Time(std::chrono::milliseconds(999'900));
  Trajectory brake_;
};

TEST_F(RecedingHorizonHalfwayThroughABrake, WhereNoNewPlanIsSafeItIsFlownToItsEnd) {
  ASSERT_EQ(planWith(0.72, false).reason, Reason::kRetreating) << "braking anew comes too near";
  const Decision decision = planWith(0.72, true);
  EXPECT_EQ(decision.reason, Reason::kKeeping);
  EXPECT_EQ(decision.candidate, kBrakeInForce);
  EXPECT_EQ(decision.candidates, kCandidateCount + 1);
  EXPECT_TRUE(decision.brake_verified);
  EXPECT_LT((decision.brake.atEnd().position_m - brake_.atEnd().position_m).norm(), 1e-12);
  EXPECT_EQ(decision.brake.start(), decision.stamp);
}

TEST_F(RecedingHorizonHalfwayThroughABrake, TooNearToStandItIsStillTheBetterStop) {
  const Decision anew = planWith(0.55, false);
  const Decision decision = planWith(0.55, true);
  EXPECT_EQ(decision.reason, Reason::kRetreating);
  EXPECT_EQ(decision.candidate, kBrakeInForce);
  EXPECT_FALSE(decision.brake_verified);
  EXPECT_LT(decision.risk, anew.risk);
}

TEST_F(RecedingHorizonHalfwayThroughABrake, WithRoomAMotionThatLeadsFartherGoesBeforeIt) {
  EXPECT_NE(planWith(4.0, true).candidate, kBrakeInForce);
}

}  // namespace
}  // namespace nanomap
