#include "planner/retreat.h"

#include <gtest/gtest.h>

#include "planner/receding_horizon.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::Block;
using test::DrawnWorld;
using test::Flight;
using test::goalAt;

/// A wall across the way whose face is `distance_m` ahead of a vehicle that hovers: it has drifted there.
Flight driftedTowards(double distance_m) {
  constexpr double kFace_m = 6.0;
  Flight flight(DrawnWorld{{Block{{kFace_m, -20.0, 0.0}, {kFace_m + 1.0, 20.0, 12.0}}}},
                {kFace_m - distance_m, 0.0, 2.0}, 0.0);
  flight.look();
  return flight;
}

TEST(Retreat, TooNearToAWallTheVehicleMovesAwayFromIt) {
  for (const double distance_m : {0.55, 0.45}) {
    const Flight flight = driftedTowards(distance_m);
    const Decision decision =
        flight.planner().plan(flight.snapshot(), flight.state(), goalAt({50.0, 0.0, 2.0}), flight.now());
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
  const Flight flight = driftedTowards(1.5);
  const Decision decision =
      flight.planner().plan(flight.snapshot(), flight.state(), goalAt({50.0, 0.0, 2.0}), flight.now());
  EXPECT_EQ(decision.reason, Reason::kBlocked);
}

TEST(Retreat, InClosedLoopItEndsWhereStandingIsSafe) {
  Flight flight = driftedTowards(0.5);
  const auto decisions = flight.fly(goalAt({50.0, 0.0, 2.0}), 6.0);
  EXPECT_EQ(decisions.front().reason, Reason::kRetreating);
  EXPECT_EQ(decisions.back().reason, Reason::kBlocked);
  EXPECT_TRUE(decisions.back().brake_verified);
}

TEST(Retreat, WhatComesNearerFirstIsNone) {
  const Flight flight = driftedTowards(0.55);
  VehicleState fast = flight.state();
  fast.velocity_W_m_s = {2.0, 0.0, 0.0};
  const Decision decision = flight.planner().plan(flight.snapshot(), fast, goalAt({50.0, 0.0, 2.0}), flight.now());
  EXPECT_EQ(decision.reason, Reason::kNothingVerified);
  EXPECT_FALSE(isFlyable(decision));
}

}  // namespace
}  // namespace nanomap
