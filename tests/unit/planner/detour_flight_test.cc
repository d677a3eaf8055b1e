#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::Block;
using test::DrawnWorld;
using test::Flight;
using test::goalAt;

constexpr double kRadius_m = 0.4;
constexpr double kHigh_m = 12.0;  ///< above the band that the planner keeps to

PlannerParameters withDetours() {
  PlannerParameters parameters = test::flightParameters();
  parameters.detour = DetourParameters();
  return parameters;
}

Block wall(double low_x_m, double low_y_m, double high_x_m, double high_y_m) {
  return {{low_x_m, low_y_m, 0.0}, {high_x_m, high_y_m, kHigh_m}};
}

bool reaches(Flight& flight, const Goal& goal, double within_s) {
  for (const Time end = flight.now() + fromSeconds(within_s); flight.now() < end;) {
    if (flight.step(goal).reason == Reason::kAtGoal && flight.motion().velocity_m_s.norm() < 0.1) return true;
  }
  return false;
}

/// Each is wider than the camera sees from where it stops the vehicle.
struct Case {
  const char* name;
  DrawnWorld world;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class WayRound : public testing::TestWithParam<Case> {};

TEST_P(WayRound, IsFoundToAGoalBehind) {
  const Goal goal = goalAt({30.0, 0.0, 2.0});
  Flight flight(GetParam().world, {0.0, 0.0, 2.0}, 0.0, withDetours());
  EXPECT_TRUE(reaches(flight, goal, 90.0)) << "it ended at " << flight.motion().position_m.transpose();
  EXPECT_GT(flight.leastClearance_m(), kRadius_m);
}

TEST_P(WayRound, IsNotFoundWithoutAMemory) {
  Flight flight(GetParam().world, {0.0, 0.0, 2.0}, 0.0);
  EXPECT_FALSE(reaches(flight, goalAt({30.0, 0.0, 2.0}), 30.0)) << "the test above proves nothing";
}

INSTANTIATE_TEST_SUITE_P(Obstacles, WayRound,
                         testing::Values(Case{"Wall", {{wall(8.0, -14.0, 8.5, 14.0)}}},
                                         Case{"WallWithALongerSide", {{wall(8.0, -8.0, 8.5, 25.0)}}},
                                         Case{"DeadEnd",
                                              {{wall(12.0, -6.0, 12.5, 6.0), wall(2.0, 6.0, 12.5, 6.5),
                                                wall(2.0, -6.5, 12.5, -6.0)}}}),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(DetourFlight, SaysThatItGoesRound) {
  Flight flight({{wall(8.0, -14.0, 8.5, 14.0)}}, {0.0, 0.0, 2.0}, 0.0, withDetours());
  const std::vector<Decision> decisions = flight.fly(goalAt({30.0, 0.0, 2.0}), 15.0);
  EXPECT_GT(std::ranges::count(decisions, Reason::kGoingRound, &Decision::reason), 15);
}

TEST(DetourFlight, GoalThatIsClosedInIsGivenUpInTheEnd) {
  PlannerParameters parameters = withDetours();
  parameters.detour.give_up_after = std::chrono::seconds(25);
  const DrawnWorld world{
      {wall(8.0, -4.0, 8.5, 4.0), wall(16.0, -4.0, 16.5, 4.0), wall(8.0, -4.5, 16.5, -4.0), wall(8.0, 4.0, 16.5, 4.5)}};
  const Goal goal = goalAt({12.0, 0.0, 2.0});
  Flight flight(world, {0.0, 0.0, 2.0}, 0.0, parameters);
  (void)flight.fly(goal, 100.0);
  const Vec3 there = flight.motion().position_m;
  for (const Decision& decision : flight.fly(goal, 10.0)) EXPECT_NE(decision.reason, Reason::kGoingRound);
  EXPECT_LT((flight.motion().position_m - there).norm(), 1.0);
  EXPECT_LT(flight.motion().velocity_m_s.norm(), 0.5);
  EXPECT_GT(flight.leastClearance_m(), kRadius_m);
}

}  // namespace
}  // namespace nanomap
