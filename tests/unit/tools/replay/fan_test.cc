#include "tools/replay/fan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nanomap {
namespace {

constexpr double kRange_m = 10.0;

FanParameters single(double max_heading_rad, double max_climb_rad) {
  FanParameters parameters;
  parameters.headings = 3;
  parameters.max_heading_rad = max_heading_rad;
  parameters.climbs = 3;
  parameters.max_climb_rad = max_climb_rad;
  parameters.samples = 4;
  return parameters;
}

Vec3 at(const std::vector<UncertainPoint>& points, int climb, int heading, int sample) {
  return points[static_cast<std::size_t>((climb * 3 + heading) * 4 + sample)].mean_m;
}

TEST(Fan, MiddleMotionGoesStraightAheadToTheRange) {
  const auto points = fanPoints(single(1.0, 0.3), Quat::Identity(), kRange_m);
  ASSERT_EQ(points.size(), 36U);
  for (int i = 0; i < 4; ++i) EXPECT_LT((at(points, 1, 1, i) - Vec3(2.5 * (i + 1), 0.0, 0.0)).norm(), 1e-12);
}

TEST(Fan, MotionsEndInTheDirectionOfTheirHeading) {
  const auto points = fanPoints(single(1.0, 0.3), Quat::Identity(), kRange_m);
  const Vec3 rightmost = at(points, 1, 0, 3);
  const Vec3 leftmost = at(points, 1, 2, 3);
  EXPECT_NEAR(std::atan2(leftmost.y(), leftmost.x()), 1.0, 1e-12);
  EXPECT_NEAR(std::atan2(rightmost.y(), rightmost.x()), -1.0, 1e-12);
  EXPECT_NEAR(leftmost.norm(), kRange_m * std::sin(1.0), 1e-9);
}

TEST(Fan, MotionsAreArcs) {
  const auto points = fanPoints(single(1.0, 0.0), Quat::Identity(), kRange_m);
  const Vec3 centre(0.0, kRange_m / 2.0, 0.0);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((at(points, 1, 2, i) - centre).norm(), kRange_m / 2.0, 1e-9);
}

TEST(Fan, ClimbIsTheAngleAboveTheHorizon) {
  const auto points = fanPoints(single(1.0, 0.3), Quat::Identity(), kRange_m);
  for (int heading = 0; heading < 3; ++heading) {
    EXPECT_NEAR(at(points, 2, heading, 3).z(), kRange_m * std::sin(0.3), 1e-12);
    EXPECT_NEAR(at(points, 0, heading, 3).z(), -kRange_m * std::sin(0.3), 1e-12);
  }
}

TEST(Fan, StaysLevelWhenTheVehicleIsPitched) {
  const Quat R_W_B(Eigen::AngleAxisd(2.0, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.7, Vec3::UnitY()) *
                   Eigen::AngleAxisd(0.2, Vec3::UnitX()));
  const auto points = fanPoints(single(1.0, 0.0), R_W_B, kRange_m);
  for (const UncertainPoint& point : points) EXPECT_NEAR((R_W_B * point.mean_m).z(), 0.0, 1e-9);
  const Vec3 ahead_W = R_W_B * at(points, 1, 1, 3);
  EXPECT_NEAR(std::atan2(ahead_W.y(), ahead_W.x()), 2.0, 1e-9);
}

TEST(Fan, UncertaintyGrowsWithDistance) {
  FanParameters parameters = single(1.0, 0.3);
  parameters.deviation = {.start_std_m = 0.1, .growth_m_per_m = 0.02};
  const auto points = fanPoints(parameters, Quat::Identity(), kRange_m);
  EXPECT_TRUE(points[0].covariance_m2.isApprox(0.15 * 0.15 * Mat3::Identity()));
  EXPECT_TRUE(points[3].covariance_m2.isApprox(0.30 * 0.30 * Mat3::Identity()));
}

TEST(Fan, SingleMotionIsTheOneAhead) {
  FanParameters parameters;
  parameters.headings = parameters.climbs = parameters.samples = 1;
  const auto points = fanPoints(parameters, Quat::Identity(), kRange_m);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].mean_m, Vec3(kRange_m, 0.0, 0.0));
}

}  // namespace
}  // namespace nanomap
