#include "planner/receding_horizon.h"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace nanomap
