#include "planner/retreat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "planner/receding_horizon.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::Block;
using test::DrawnWorld;
using test::Flight;
using test::goalAt;

/// A wall across the way whose face is `distance_m` ahead of a vehicle that hovers: it has drifted there.
Flight driftedTowards(double distance_m, const PlannerParameters& parameters = test::flightParameters()) {
  constexpr double kFace_m = 6.0;
  Flight flight(DrawnWorld{{Block{{kFace_m, -20.0, 0.0}, {kFace_m + 1.0, 20.0, 12.0}}}},
                {kFace_m - distance_m, 0.0, 2.0}, 0.0, parameters);
  flight.look();
  return flight;
}

/// What it decides when it has that velocity.
Decision planAt(const Flight& flight, const Vec3& velocity_W_m_s) {
  VehicleState state = flight.state();
  state.velocity_W_m_s = velocity_W_m_s;
  return flight.planner().plan(flight.snapshot(), state, goalAt({50.0, 0.0, 2.0}), flight.now());
}

TEST(Retreat, TooNearToAWallTheVehicleMovesAwayFromIt) {
  for (const double distance_m : {0.55, 0.45}) {
    const Decision decision = planAt(driftedTowards(distance_m), Vec3::Zero());
    ASSERT_EQ(decision.reason, Reason::kRetreating) << distance_m;
    EXPECT_TRUE(isFlyable(decision));
    EXPECT_FALSE(decision.brake_verified) << "it is not within the chance constraint";
    EXPECT_GT(decision.risk, 0.001);
    const Vec3 way_W = decision.brake.atEnd().position_m - decision.brake.atStart().position_m;
    EXPECT_LT(way_W.x(), -0.05);
    EXPECT_LT(way_W.norm(), 0.8) << "no farther than the bubble reaches";
  }
}

TEST(Retreat, WithRoomToStandThereIsNone) {
  EXPECT_EQ(planAt(driftedTowards(1.5), Vec3::Zero()).reason, Reason::kBlocked);
}

TEST(Retreat, InClosedLoopItEndsWhereStandingIsSafe) {
  Flight flight = driftedTowards(0.5);
  const auto decisions = flight.fly(goalAt({50.0, 0.0, 2.0}), 6.0);
  EXPECT_EQ(decisions.front().reason, Reason::kRetreating);
  EXPECT_EQ(decisions.back().reason, Reason::kBlocked);
  EXPECT_TRUE(decisions.back().brake_verified);
}

/// One that has all but stopped, too near already: whatever it does next, it comes a little nearer first.
TEST(Retreat, AVehicleThatStillComesNearerMovesAway) {
  const Flight flight = driftedTowards(0.6);
  const Decision decision = planAt(flight, {0.3, 0.0, 0.0});
  ASSERT_EQ(decision.reason, Reason::kRetreating);
  EXPECT_NE(decision.candidate, kBrake);
  EXPECT_LT(decision.brake.atEnd().position_m.x(), decision.brake.atStart().position_m.x());
}

/// With a collision as good as certain on the way, it is the end that counts.
TEST(Retreat, WhereACollisionIsAllButCertainTheVehicleMovesAwayToo) {
  for (const auto& [distance_m, speed_m_s] : {std::pair(0.42, 0.0), {0.42, 0.2}, {0.38, 0.1}, {0.2, 0.0}}) {
    const Decision decision = planAt(driftedTowards(distance_m), {speed_m_s, 0.0, 0.0});
    ASSERT_EQ(decision.reason, Reason::kRetreating) << distance_m;
    EXPECT_LT(decision.brake.atEnd().position_m.x(), decision.brake.atStart().position_m.x() - 0.05) << distance_m;
  }
}

/// Else each plan would find the way on along the wall a little less risky than stopping beside it.
TEST(Retreat, AFastVehicleStopsFirst) {
  for (const Vec3& velocity_W_m_s : {Vec3(0.0, 2.0, 0.0), Vec3(-0.7, 1.5, 0.0), Vec3(2.0, 0.0, 0.0)}) {
    const Decision decision = planAt(driftedTowards(0.55), velocity_W_m_s);
    ASSERT_EQ(decision.reason, Reason::kRetreating) << velocity_W_m_s.transpose();
    EXPECT_EQ(decision.candidate, kBrake) << velocity_W_m_s.transpose();
    EXPECT_TRUE(isFlyable(decision));
    EXPECT_FALSE(decision.brake_verified);
  }
}

/// Less risk on the way is no reason to end where standing is more.
TEST(Retreat, WhoeverStopsInABetterPlaceStops) {
  const Block ahead{{0.55, -0.25, 0.0}, {0.75, -0.05, 12.0}};
  const Block aside{{0.6, -1.05, 0.0}, {0.8, -0.85, 12.0}};
  Flight flight(DrawnWorld{{ahead, aside}}, {0.0, 0.0, 2.0}, 0.0);
  flight.look();
  const Decision decision = planAt(flight, {-0.55, -0.65, 0.0});
  ASSERT_EQ(decision.reason, Reason::kRetreating);
  EXPECT_EQ(decision.candidate, kBrake);
}

/// With a bubble that is smaller than a step, a step back leads into what was not seen.
TEST(Retreat, AStepIntoWhatWasNotSeenIsNone) {
  PlannerParameters parameters = test::flightParameters();
  parameters.risk.collision.vehicle_radius_m = 0.1;
  parameters.risk.bubble_margin_m = 0.0;
  const Flight flight = driftedTowards(0.25, parameters);
  const Decision decision = planAt(flight, Vec3::Zero());
  ASSERT_EQ(decision.reason, Reason::kRetreating);
  EXPECT_LT((decision.brake.atEnd().position_m - decision.brake.atStart().position_m).norm(), 0.1);
}

TEST(Retreat, AStopInWhatWasNotSeenIsNone) {
  const Decision decision = planAt(driftedTowards(0.55), {-6.0, 0.0, 0.0});
  EXPECT_EQ(decision.reason, Reason::kNothingVerified);
  EXPECT_FALSE(isFlyable(decision));
}

/// What a vehicle stands before is in views from farther back only, which know less from second to second. Whatever it
/// does about that, it is never without a plan, and stands safely in the end.
TEST(Retreat, AVehicleThatStandsWhereOnlyOldViewsLookIsNeverWithoutAPlan) {
  Flight flight = driftedTowards(2.0);
  (void)flight.fly(std::nullopt, 0.5);
  flight.setMotion({flight.motion().position_m + Vec3(1.2, 0.0, 0.0), Vec3::Zero(), Vec3::Zero()});
  const auto decisions = flight.fly(goalAt({50.0, 0.0, 2.0}), 10.0);
  const auto count = [&](Reason reason) {
    return std::ranges::count_if(decisions, [=](const Decision& decision) { return decision.reason == reason; });
  };
  EXPECT_GT(count(Reason::kRetreating), 0) << "the scene is harmless";
  EXPECT_EQ(count(Reason::kNothingVerified), 0);
  EXPECT_TRUE(decisions.back().brake_verified);
  EXPECT_GT(flight.leastClearance_m(), 0.7);
}

}  // namespace
}  // namespace nanomap
