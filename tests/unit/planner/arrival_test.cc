#include "planner/arrival.h"

#include <gtest/gtest.h>

#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::goalAt;

constexpr double kTolerance_m = 0.5;
const Vec3 kStandstill_W_m(0.3, 0.0, 2.0);

Decision decisionToStand(Reason reason) {
  Decision decision;
  decision.reason = reason;
  decision.brake = Trajectory({}, {kStandstill_W_m, Vec3::Zero(), Vec3::Zero()});
  return decision;
}

Vec3 steeredFor(Arrival& arrival, const Vec3& goal_W_m) { return arrival.steer(goalAt(goal_W_m)).position_W_m; }

TEST(Arrival, BeforeThereIsOneTheGoalIsSteeredFor) {
  Arrival arrival(kTolerance_m);
  const Vec3 goal_W_m(0.0, 0.0, 2.0);
  EXPECT_EQ(steeredFor(arrival, goal_W_m), goal_W_m);
  for (const Reason reason : {Reason::kFlying, Reason::kBlocked, Reason::kNoGoal}) {
    arrival.note(decisionToStand(reason));
    EXPECT_EQ(steeredFor(arrival, goal_W_m), goal_W_m) << toString(reason);
  }
}

TEST(Arrival, WhereTheVehicleStandsItStaysUntilTheGoalIsFarOff) {
  Arrival arrival(kTolerance_m);
  arrival.note(decisionToStand(Reason::kAtGoal));
  for (const double off_m : {0.0, kTolerance_m + 0.01, 1.5 * kTolerance_m - 0.01}) {
    EXPECT_EQ(steeredFor(arrival, kStandstill_W_m + Vec3(0.0, off_m, 0.0)), kStandstill_W_m) << off_m;
  }
  const Vec3 far_W_m = kStandstill_W_m + Vec3(0.0, 1.5 * kTolerance_m + 0.01, 0.0);
  EXPECT_EQ(steeredFor(arrival, far_W_m), far_W_m);
  const Vec3 nearer_W_m = kStandstill_W_m + Vec3(0.0, kTolerance_m + 0.01, 0.0);
  EXPECT_EQ(steeredFor(arrival, nearer_W_m), nearer_W_m) << "it has left";
}

TEST(Arrival, StandingOnMovesThePlaceNoFarther) {
  Arrival arrival(kTolerance_m);
  arrival.note(decisionToStand(Reason::kAtGoal));
  Decision drifted = decisionToStand(Reason::kAtGoal);
  drifted.brake = Trajectory({}, {kStandstill_W_m + Vec3(0.2, 0.0, 0.0), Vec3::Zero(), Vec3::Zero()});
  arrival.note(drifted);
  EXPECT_EQ(steeredFor(arrival, kStandstill_W_m), kStandstill_W_m);
}

TEST(Arrival, KeepsWhatElseTheGoalSays) {
  Arrival arrival(kTolerance_m);
  arrival.note(decisionToStand(Reason::kAtGoal));
  const Goal goal = goalAt({0.0, 0.0, 2.0}, 3.0);
  const Goal steered = arrival.steer(goal);
  EXPECT_EQ(steered.sequence, goal.sequence);
  EXPECT_EQ(steered.top_speed_m_s, goal.top_speed_m_s);
}

TEST(Arrival, OfAnotherWorldCountsForNothing) {
  Arrival arrival(kTolerance_m);
  arrival.note(decisionToStand(Reason::kAtGoal));
  Goal goal = goalAt({0.0, 0.0, 2.0});
  ++goal.epoch;
  EXPECT_EQ(arrival.steer(goal).position_W_m, goal.position_W_m);
}

}  // namespace
}  // namespace nanomap
