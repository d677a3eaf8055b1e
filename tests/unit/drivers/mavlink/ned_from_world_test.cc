#include "drivers/mavlink/ned_from_world.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace nanomap {
namespace {

constexpr double kTolerance = 1e-12;
constexpr double kHeading_rad = 70.0 * std::numbers::pi / 180.0;

/// W's x axis points 70 degrees east of north, its origin lies at north 100, east -20, 3 m below the autopilot's.
NedFromWorld turned() { return {kHeading_rad, Vec3(100.0, -20.0, 3.0)}; }

TEST(NedFromWorld, OfNothingFlipsTheAxes) {
  EXPECT_LT((NedFromWorld().point({1.0, 2.0, 3.0}) - Vec3(1.0, -2.0, -3.0)).norm(), kTolerance);
}

TEST(NedFromWorld, TurnsClockwiseFromNorthAndShifts) {
  const NedFromWorld T_NED_W = turned();
  EXPECT_LT((T_NED_W.point(Vec3::Zero()) - Vec3(100.0, -20.0, 3.0)).norm(), kTolerance);
  // Ahead in W is mostly east; left of that is mostly north; up is less down.
  EXPECT_LT((T_NED_W.direction(Vec3::UnitX()) - Vec3(0.3420201433, 0.9396926208, 0.0)).norm(), 1e-9);
  EXPECT_LT((T_NED_W.direction(Vec3::UnitY()) - Vec3(0.9396926208, -0.3420201433, 0.0)).norm(), 1e-9);
  EXPECT_LT((T_NED_W.direction(Vec3::UnitZ()) - Vec3(0.0, 0.0, -1.0)).norm(), kTolerance);
  EXPECT_LT((T_NED_W.point({10.0, 0.0, 2.0}) - Vec3(103.420201433, -10.603073792, 1.0)).norm(), 1e-8);
}

TEST(NedFromWorld, HeadingGoesAgainstYaw) {
  const NedFromWorld T_NED_W = turned();
  EXPECT_NEAR(T_NED_W.heading(0.0), kHeading_rad, kTolerance);
  EXPECT_NEAR(T_NED_W.heading(kHeading_rad), 0.0, kTolerance);                    // turned left, to the north
  EXPECT_NEAR(T_NED_W.heading(-2.5), wrapAngle(kHeading_rad + 2.5), kTolerance);  // wraps
  EXPECT_NEAR(T_NED_W.heading(T_NED_W.heading(0.4)), 0.4, kTolerance);            // its own inverse
  const Vec3 ahead_NED = T_NED_W.direction({std::cos(0.4), std::sin(0.4), 0.0});
  EXPECT_NEAR(std::atan2(ahead_NED.y(), ahead_NED.x()), T_NED_W.heading(0.4), kTolerance);
}

TEST(NedFromWorld, IsUndoneByItsInverse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-50.0, 50.0);
  for (int i = 0; i < 100; ++i) {
    const NedFromWorld T_NED_W(draw(random), {draw(random), draw(random), draw(random)});
    const Vec3 p_W{draw(random), draw(random), draw(random)};
    EXPECT_LT((T_NED_W.pointInWorld(T_NED_W.point(p_W)) - p_W).norm(), 1e-10);
    EXPECT_LT((T_NED_W.directionInWorld(T_NED_W.direction(p_W)) - p_W).norm(), 1e-10);
    EXPECT_NEAR(T_NED_W.pose().rotation.norm(), 1.0, kTolerance);
  }
}

TEST(Flipped, TurnsAxesOfVectorsAndOfBothSidesOfARotation) {
  EXPECT_EQ(flipped(Vec3(1.0, 2.0, 3.0)), Vec3(1.0, -2.0, -3.0));
  const Quat R_A_B = Quat(0.8, 0.1, -0.3, 0.5).normalized();
  const Vec3 v_B{1.0, 2.0, 3.0};
  EXPECT_LT((flipped(R_A_B) * flipped(v_B) - flipped(Vec3(R_A_B * v_B))).norm(), kTolerance);
  EXPECT_TRUE(flipped(flipped(R_A_B)).isApprox(R_A_B));
}

}  // namespace
}  // namespace nanomap
