#include "core/level_frame.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

constexpr double kYaw_rad = 1.2;

Quat pitched(double pitch_rad) {
  return Eigen::AngleAxisd(kYaw_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY());
}

TEST(LevelFrame, KeepsTheYawOfAPitchedBodyAndStaysUpright) {
  for (const double pitch_rad : {-0.7, 0.0, 0.7}) {
    const Quat R_W_B = pitched(pitch_rad);
    EXPECT_NEAR(yawOf(R_W_B), kYaw_rad, 1e-12);
    const Mat3 R_W_L = levelAxes(yawOf(R_W_B));
    EXPECT_LT((R_W_L * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_LT((R_W_L * Vec3::UnitX() - Vec3(std::cos(kYaw_rad), std::sin(kYaw_rad), 0.0)).norm(), 1e-12);
  }
}

TEST(LevelFrame, OfABodyThatLooksStraightUpIsStillUpright) {
  const Mat3 R_W_L = levelAxes(yawOf(pitched(-std::numbers::pi / 2.0)));
  EXPECT_TRUE(R_W_L.allFinite());
  EXPECT_LT((R_W_L * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(WrapAngle, StaysWithinHalfATurn) {
  EXPECT_NEAR(wrapAngle(3.5 * std::numbers::pi), -0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(wrapAngle(-1.25 * std::numbers::pi), 0.75 * std::numbers::pi, 1e-12);
  EXPECT_EQ(wrapAngle(0.25), 0.25);
}

}  // namespace
}  // namespace nanomap
