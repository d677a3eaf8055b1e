#include "tests/unit/planner/flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace nanomap {
namespace {

using test::Block;
using test::DrawnWorld;
using test::Flight;
using test::goalAt;

constexpr double kRadius_m = 0.4;

std::size_t countOf(const std::vector<Decision>& decisions, Reason reason) {
  return static_cast<std::size_t>(
      std::ranges::count_if(decisions, [&](const Decision& decision) { return decision.reason == reason; }));
}

class EmptyField : public testing::TestWithParam<double> {};

TEST_P(EmptyField, TakesOffFromHoverAndFliesAtTopSpeed) {
  const double height_m = GetParam();
  Flight flight(DrawnWorld{}, {0.0, 0.0, height_m}, 0.0);
  const std::vector<Decision> decisions = flight.fly(goalAt({100.0, 0.0, height_m}), 5.0);
  EXPECT_EQ(countOf(decisions, Reason::kFlying), decisions.size());
  EXPECT_GT(flight.motion().position_m.x(), 10.0);
  EXPECT_GT(flight.motion().velocity_m_s.x(), 3.0);
  EXPECT_LT(flight.fastest_m_s(), 5.0);
  EXPECT_NEAR(flight.motion().position_m.y(), 0.0, 0.5);
  EXPECT_GT(flight.motion().position_m.z(), height_m - 0.5);
  EXPECT_LT(flight.motion().position_m.z(), std::max(height_m + 0.5, 3.0))
      << "the ground is an obstacle: low, it climbs";
  for (const Decision& decision : decisions) {
    EXPECT_TRUE(decision.brake_verified);
    EXPECT_LE(decision.risk, 0.001);
    EXPECT_LE(decision.brake_risk, 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, EmptyField, testing::Values(1.5, 2.0, 4.0));

TEST(Flight, NoGoalIsFlownFasterThanTheVehicleMayFly) {
  PlannerParameters parameters = test::flightParameters();
  parameters.limits.top_speed_m_s = 3.0;
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0, parameters);
  (void)flight.fly(goalAt({100.0, 0.0, 2.0}, 50.0), 6.0);
  EXPECT_GT(flight.fastest_m_s(), 2.5);
  EXPECT_LT(flight.fastest_m_s(), 4.0);
}

TEST(Flight, StopsAtTheGoalAndStaysThere) {
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0);
  const Vec3 goal_W(8.0, 1.0, 2.5);
  (void)flight.fly(goalAt(goal_W), 6.0);
  const std::vector<Decision> arrived = flight.fly(goalAt(goal_W), 1.0);
  EXPECT_EQ(countOf(arrived, Reason::kAtGoal), arrived.size());
  EXPECT_LT((flight.motion().position_m - goal_W).norm(), 0.6);
  EXPECT_LT(flight.motion().velocity_m_s.norm(), 1e-3);
}

TEST(Flight, GoesAroundAPillar) {
  const DrawnWorld world{{Block{{7.0, -0.5, 0.0}, {8.0, 0.6, 8.0}}}};
  Flight flight(world, {0.0, 0.0, 2.0}, 0.0);
  (void)flight.fly(goalAt({20.0, 0.0, 2.0}), 12.0);
  EXPECT_GT(flight.motion().position_m.x(), 9.0);
  EXPECT_GT(flight.leastClearance_m(), kRadius_m);
}

/// A wall across the way, and straight ahead in it a pane that the vehicle would fit through.
class GlassInAWall : public testing::TestWithParam<double> {};

TEST_P(GlassInAWall, IsNotFlownInto) {
  const double half_m = GetParam() / 2.0;
  DrawnWorld world{{Block{{8.0, -20.0, 0.0}, {8.5, 20.0, 12.0}}}};
  world.blocks.push_back({{7.9, -half_m, 2.0 - half_m}, {8.0, half_m, 2.0 + half_m}, true});
  Flight flight(world, {0.0, 0.0, 2.0}, 0.0);
  const std::vector<Decision> decisions = flight.fly(goalAt({30.0, 0.0, 2.0}), 12.0);
  EXPECT_GT(flight.motion().position_m.x(), 3.0) << "it comes near";
  EXPECT_GT(flight.leastClearance_m(), kRadius_m);
  EXPECT_GT(countOf(decisions, Reason::kBlocked), 0U);
  EXPECT_TRUE(std::ranges::any_of(decisions, [](const Decision& decision) {
    return decision.vetoes.by_status[static_cast<std::size_t>(Status::kHole)] > 0;
  }));
}

INSTANTIATE_TEST_SUITE_P(PaneWidths_m, GlassInAWall, testing::Values(0.8, 1.2, 2.0));

TEST(Flight, LooksAroundInsteadOfFreezingInFrontOfAWall) {
  const DrawnWorld world{{Block{{3.0, -40.0, 0.0}, {3.5, 40.0, 12.0}}}};
  Flight flight(world, {0.0, 0.0, 2.0}, 0.0);
  (void)flight.fly(goalAt({30.0, 0.0, 2.0}), 5.0);
  double lowest_rad = flight.yaw_W_rad();
  double highest_rad = flight.yaw_W_rad();
  // A sweep takes 7 s; steps to the side, where there seems to be a way, turn it back.
  for (const Time end = flight.now() + std::chrono::seconds(16); flight.now() < end;) {
    const Decision decision = flight.step(goalAt({30.0, 0.0, 2.0}));
    EXPECT_TRUE(decision.brake_verified || decision.reason == Reason::kRetreating);
    lowest_rad = std::min(lowest_rad, flight.yaw_W_rad());
    highest_rad = std::max(highest_rad, flight.yaw_W_rad());
  }
  EXPECT_LT(lowest_rad, -0.6);
  EXPECT_GT(highest_rad, 0.6);
  EXPECT_GT(flight.leastClearance_m(), kRadius_m);
}

TEST(Flight, TurnsToAGoalBehindItAndThenFliesThere) {
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, std::numbers::pi / 2.0);
  const Goal goal = goalAt({0.0, -12.0, 2.0});
  EXPECT_EQ(flight.step(goal).reason, Reason::kTurning);
  (void)flight.fly(goal, 10.0);
  EXPECT_LT((flight.motion().position_m - goal.position_W_m).norm(), 0.6);
}

/// Whatever the planner does, it can stop: the brake of every decision ends clear of everything.
TEST(Flight, EveryVerifiedBrakeEndsClearOfEverythingDrawn) {
  const DrawnWorld world{{Block{{7.0, -3.0, 0.0}, {7.6, 0.3, 8.0}}, Block{{12.0, -1.0, 0.0}, {12.6, 4.0, 8.0}}}};
  Flight flight(world, {0.0, 0.0, 2.0}, 0.0);
  for (const Decision& decision : flight.fly(goalAt({25.0, 0.0, 2.0}), 12.0)) {
    if (!decision.brake_verified) continue;
    for (double t_s = 0.0; t_s <= decision.brake.duration_s(); t_s += 0.02) {
      ASSERT_GT(world.clearance_m(decision.brake.sample(t_s).position_m), kRadius_m);
    }
  }
}

}  // namespace
}  // namespace nanomap
