#include "tools/doctor/plane.h"

#include <gtest/gtest.h>

#include <random>

namespace nanomap::doctor {
namespace {

bool any(const Vec3& /*normal*/) { return true; }

/// So many points of the plane z = -1.5, within 5 m beside its middle, as noisy as a camera's.
std::vector<Vec3> floorPoints(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> place_m(-5.0, 5.0);
  std::normal_distribution<double> noise_m(0.0, 0.02);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place_m(random), place_m(random), -1.5 + noise_m(random));
  return points;
}

TEST(LargestPlane, IsFoundAmongTwiceAsManyPointsElsewhere) {
  std::mt19937 random(1);
  std::vector<Vec3> points = floorPoints(400, random);
  std::uniform_real_distribution<double> place_m(-5.0, 5.0);
  for (int i = 0; i < 800; ++i) points.emplace_back(place_m(random), place_m(random), std::abs(place_m(random)));
  const auto plane = largestPlane(points, any);
  ASSERT_TRUE(plane);
  EXPECT_GT(plane->normal.z(), 0.999) << "towards the origin: up";
  EXPECT_NEAR(plane->distance_m, 1.5, 0.02);
  EXPECT_NEAR(plane->share, 1.0 / 3.0, 0.03);
  EXPECT_EQ(plane->share_behind, 0.0);
}

TEST(LargestPlane, WhatLiesBehindItIsCounted) {
  std::mt19937 random(2);
  std::vector<Vec3> points = floorPoints(300, random);
  for (int i = 0; i < 100; ++i) points.emplace_back(0.01 * i, 0.0, -4.0);
  EXPECT_NEAR(largestPlane(points, any).value().share_behind, 0.25, 1e-9);
}

TEST(LargestPlane, OneThatMayNotBeIsPassedOver) {
  std::mt19937 random(3);
  std::vector<Vec3> points = floorPoints(400, random);
  for (const Vec3& floor : floorPoints(200, random)) points.emplace_back(floor.z(), floor.x(), floor.y());
  const auto upright = largestPlane(points, [](const Vec3& normal) { return std::abs(normal.z()) < 0.5; });
  ASSERT_TRUE(upright);
  EXPECT_GT(upright->normal.x(), 0.999);
  EXPECT_FALSE(largestPlane(points, [](const Vec3&) { return false; }));
}

TEST(LargestPlane, PointsThatTellNoneGiveNone) {
  EXPECT_FALSE(largestPlane({}, any));
  EXPECT_FALSE(largestPlane({Vec3::UnitX(), Vec3::UnitY()}, any));
  EXPECT_FALSE(largestPlane(std::vector<Vec3>(50, Vec3::UnitX()), any)) << "all the same";
  std::vector<Vec3> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(1.0, i, 0.0);
  EXPECT_FALSE(largestPlane(line, any));
}

TEST(LargestPlane, IsTheSameEachTime) {
  std::mt19937 random(4);
  const std::vector<Vec3> points = floorPoints(200, random);
  EXPECT_EQ(largestPlane(points, any).value().normal, largestPlane(points, any).value().normal);
}

}  // namespace
}  // namespace nanomap::doctor
