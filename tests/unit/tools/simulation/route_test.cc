#include "tools/simulation/route.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nanomap::simulation {
namespace {

using Vec2 = Eigen::Vector2d;

Mission across() {
  Mission mission;
  mission.start_W = {0.0, 0.0, 2.0};
  mission.goal_W = {20.0, 0.0, 2.0};
  mission.region_W = Box3(Vec3(-2.0, -10.0, 0.0), Vec3(22.0, 10.0, 4.0));
  return mission;
}

double lengthOf(const std::vector<Vec2>& route_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route_m.size(); ++i) length_m += (route_m[i] - route_m[i - 1]).norm();
  return length_m;
}

TEST(Route, WithoutObstaclesIsTheStraightLine) {
  const auto route_m = planRoute(Scene("empty", across(), {}), 1.0);
  ASSERT_TRUE(route_m);
  EXPECT_THAT(*route_m, testing::ElementsAre(Vec2(0.0, 0.0), Vec2(20.0, 0.0)));
}

TEST(Route, AroundAPillarIsLittleLongerThanTheTautString) {
  constexpr double kRadius_m = 2.0;
  constexpr double kClearance_m = 1.0;
  const Scene scene("pillar", across(), {Cylinder{{10.0, 0.0, 0.0}, {10.0, 0.0, 4.0}, kRadius_m}});
  const auto route_m = planRoute(scene, kClearance_m);
  ASSERT_TRUE(route_m);
  // Two tangents and the arc between them.
  const double r = kRadius_m + kClearance_m;
  const double taut_m = 2.0 * std::sqrt(100.0 - r * r) + 2.0 * r * std::asin(r / 10.0);
  EXPECT_GE(lengthOf(*route_m), taut_m - 0.3);
  EXPECT_LE(lengthOf(*route_m), taut_m + 0.6);
  for (std::size_t i = 1; i < route_m->size(); ++i) {
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const Vec2 p = (*route_m)[i - 1] + share * ((*route_m)[i] - (*route_m)[i - 1]);
      EXPECT_GT(scene.distanceToNearestObstacle({p.x(), p.y(), 2.0}), kClearance_m - 0.25);
    }
  }
}

TEST(Route, WhatStandsAboveOrBelowIsIgnored) {
  const Scene scene("beams", across(),
                    {UprightBox{.center_W = {10.0, 0.0, 5.0}, .half_size_m = {0.5, 10.0, 1.0}},
                     UprightBox{.center_W = {12.0, 0.0, 0.2}, .half_size_m = {0.5, 10.0, 0.2}}});
  const auto route_m = planRoute(scene, 0.9);
  ASSERT_TRUE(route_m);
  EXPECT_EQ(route_m->size(), 2U);
}

TEST(Route, PassesItsViaPointsInTurn) {
  Mission mission = across();
  mission.via_W = {{5.0, 6.0, 2.0}, {15.0, -6.0, 2.0}};
  const auto route_m = planRoute(Scene("via", mission, {}), 1.0);
  ASSERT_TRUE(route_m);
  EXPECT_THAT(*route_m, testing::ElementsAre(Vec2(0.0, 0.0), Vec2(5.0, 6.0), Vec2(15.0, -6.0), Vec2(20.0, 0.0)));
}

TEST(Route, WhenTheGapIsTooNarrowThereIsNone) {
  const Scene scene("gap", across(),
                    {UprightBox{.center_W = {10.0, 6.0, 2.0}, .half_size_m = {0.5, 5.0, 2.0}},
                     UprightBox{.center_W = {10.0, -6.0, 2.0}, .half_size_m = {0.5, 5.0, 2.0}}});
  EXPECT_TRUE(planRoute(scene, 0.8));
  EXPECT_FALSE(planRoute(scene, 1.1));
}

TEST(Route, WithTheGoalInsideAnObstacleThereIsNone) {
  EXPECT_FALSE(planRoute(Scene("buried", across(), {Sphere{{20.0, 0.0, 2.0}, 1.0}}), 0.5));
}

}  // namespace
}  // namespace nanomap::simulation
