#include "planner/heading.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/level_frame.h"
#include "tests/support/camera.h"

namespace nanomap {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Turn, GoesTheShorterWayAtALimitedRate) {
  const HeadingParameters parameters;
  const HeadingCommand left = turn(3.0, -3.0, parameters);
  EXPECT_NEAR(left.yaw_W_rad, -3.0, 1e-12);
  EXPECT_NEAR(left.rate_rad_s, (2.0 * kPi - 6.0) / parameters.reach_s, 1e-12);
  const HeadingCommand right = turn(0.0, -2.0, parameters);
  EXPECT_DOUBLE_EQ(right.rate_rad_s, -parameters.max_rate_rad_s);
  EXPECT_DOUBLE_EQ(right.yaw_W_rad, -parameters.max_rate_rad_s * parameters.reach_s);
  EXPECT_EQ(turn(1.0, 1.0, parameters).rate_rad_s, 0.0);
}

TEST(Sweep, IsAContinuousWaveBetweenItsAmplitudes) {
  const HeadingParameters parameters;
  double lowest_rad = 0.0;
  double highest_rad = 0.0;
  double previous_rad = sweepOffset(Time{}, parameters);
  for (int ms = 10; ms < 20'000; ms += 10) {
    const double offset_rad = sweepOffset(Time(std::chrono::milliseconds(ms)), parameters);
    EXPECT_LE(std::abs(offset_rad - previous_rad), 0.01 * parameters.sweep_rate_rad_s + 1e-9);
    lowest_rad = std::min(lowest_rad, offset_rad);
    highest_rad = std::max(highest_rad, offset_rad);
    previous_rad = offset_rad;
  }
  EXPECT_NEAR(lowest_rad, -parameters.sweep_amplitude_rad, 0.01);
  EXPECT_NEAR(highest_rad, parameters.sweep_amplitude_rad, 0.01);
}

TEST(HorizontalView, IsWhereTheCameraPointsAndHowWide) {
  CameraParameters camera = test::smallCamera();
  EXPECT_NEAR(horizontalView(CameraModel(camera)).yaw_B_rad, 0.0, 1e-12);
  EXPECT_NEAR(horizontalView(CameraModel(camera)).half_width_rad, kPi / 4.0, 0.02);
  camera.T_B_C.rotation = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())) * camera.T_B_C.rotation;
  EXPECT_NEAR(horizontalView(CameraModel(camera)).yaw_B_rad, 0.5, 1e-12);
}

TEST(LevelFrame, HasTheYawOfTheBodyHoweverPitched) {
  for (const double pitch_rad : {-1.2, 0.0, 0.7}) {
    const Quat R_W_B(Eigen::AngleAxisd(2.0, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()));
    EXPECT_NEAR(yawOf(R_W_B), 2.0, 1e-12);
  }
  EXPECT_LT((levelAxes(0.5 * kPi) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(wrapAngle(3.0 * kPi / 2.0), -kPi / 2.0, 1e-12);
}

}  // namespace
}  // namespace nanomap
