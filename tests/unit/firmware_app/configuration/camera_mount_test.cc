#include "firmware_app/configuration/camera_mount.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace nanomap {
namespace {

constexpr double kTolerance = 1e-9;

void expectNear(const Vec3& actual, const Vec3& expected) {
  EXPECT_LT((actual - expected).norm(), kTolerance) << actual.transpose() << " is not " << expected.transpose();
}

TEST(CameraMount, ForwardLookingCameraSeesForward) {
  const Quat R_B_C = rotationOfMount({});
  expectNear(R_B_C * Vec3::UnitZ(), Vec3::UnitX());
  expectNear(R_B_C * Vec3::UnitX(), -Vec3::UnitY());
  expectNear(R_B_C * Vec3::UnitY(), -Vec3::UnitZ());
}

TEST(CameraMount, PositivePitchTiltsTheViewDown) {
  const double s = std::sin(M_PI / 6);
  const double c = std::cos(M_PI / 6);
  expectNear(rotationOfMount({.pitch_deg = 30.0}) * Vec3::UnitZ(), {c, 0.0, -s});
}

TEST(CameraMount, PositiveYawTurnsTheViewLeft) {
  expectNear(rotationOfMount({.yaw_deg = 90.0}) * Vec3::UnitZ(), Vec3::UnitY());
}

TEST(CameraMount, PositiveRollLowersTheRightSide) {
  expectNear(rotationOfMount({.roll_deg = 90.0}) * Vec3::UnitX(), -Vec3::UnitZ());
}

RC_GTEST_PROP(CameraMount, AnglesGiveTheRotationBack, ()) {
  const auto angle = [](int limit_deg) { return *rc::gen::inRange(-limit_deg, limit_deg + 1); };
  const MountAngles angles{static_cast<double>(angle(180)), static_cast<double>(angle(90)),
                           static_cast<double>(angle(180))};
  const Quat R_B_C = rotationOfMount(angles);
  RC_ASSERT(rotationOfMount(anglesOfMount(R_B_C)).angularDistance(R_B_C) < 1e-6);
}

TEST(CameraMount, StraightDownHasNoRoll) {
  const MountAngles angles = anglesOfMount(rotationOfMount({.roll_deg = 20.0, .pitch_deg = 90.0}));
  EXPECT_NEAR(angles.pitch_deg, 90.0, 1e-5);
  EXPECT_EQ(angles.roll_deg, 0.0);
}

}  // namespace
}  // namespace nanomap
