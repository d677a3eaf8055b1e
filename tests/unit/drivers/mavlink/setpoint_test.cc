#include "drivers/mavlink/setpoint.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

const NedFromWorld kT_NED_W(70.0 * std::numbers::pi / 180.0, Vec3(100.0, -20.0, 3.0));
const Time kStamp = Time(1234567890us);

MotionSetpoint motion() { return {kStamp, {{10.0, 0.0, 2.0}, {2.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}, 0.5}; }

TEST(Setpoint, OfMotionHasPositionVelocityAccelerationAndHeading) {
  const LocalNedTarget target = toNed(motion(), kT_NED_W);
  EXPECT_EQ(target.time_boot_ms, 1234567U);
  EXPECT_EQ(target.type_mask, 2048);  // ignores the yaw rate only
  EXPECT_LT((target.position_NED_m - Vec3f(103.4202F, -10.60307F, 1.0F)).norm(), 1e-4F);
  EXPECT_LT((target.velocity_NED_m_s - Vec3f(0.6840403F, 1.8793852F, 1.0F)).norm(), 1e-6F);
  EXPECT_LT((target.acceleration_NED_m_s2 - Vec3f(0.9396926F, -0.3420201F, 0.0F)).norm(), 1e-6F);
  EXPECT_NEAR(target.yaw_NED_rad, 70.0 * std::numbers::pi / 180.0 - 0.5, 1e-6);
  EXPECT_TRUE(target.isFinite());
}

TEST(Setpoint, OfVelocityTellsToIgnoreThePosition) {
  const LocalNedTarget target = toNed(VelocitySetpoint{kStamp, {2.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 0.5}, kT_NED_W);
  EXPECT_EQ(target.type_mask, 2048 + 7);
  EXPECT_TRUE(target.position_NED_m.isZero());
  EXPECT_LT((target.acceleration_NED_m_s2 - Vec3f(0.9396926F, -0.3420201F, 0.0F)).norm(), 1e-6F);
  EXPECT_LT((target.velocity_NED_m_s - Vec3f(0.6840403F, 1.8793852F, 1.0F)).norm(), 1e-6F);
}

TEST(Setpoint, WithoutYawTellsToIgnoreIt) {
  MotionSetpoint setpoint = motion();
  setpoint.yaw_W_rad.reset();
  EXPECT_EQ(toNed(setpoint, kT_NED_W).type_mask, 3072);
  EXPECT_EQ(toNed(setpoint, kT_NED_W).yaw_NED_rad, 0.0F);
  EXPECT_EQ(toNed(VelocitySetpoint{kStamp, Vec3::Zero(), Vec3::Zero(), std::nullopt}, kT_NED_W).type_mask, 3079);
}

TEST(Setpoint, OfWhatIsNotFiniteSaysSo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MotionSetpoint setpoint = motion();
  setpoint.motion_W.position_m.y() = nan;
  EXPECT_FALSE(toNed(setpoint, kT_NED_W).isFinite());
  setpoint = motion();
  setpoint.yaw_W_rad = nan;
  EXPECT_FALSE(toNed(setpoint, kT_NED_W).isFinite());
  setpoint = motion();
  setpoint.motion_W.velocity_m_s.z() = 1e39;  // no float
  EXPECT_FALSE(toNed(setpoint, kT_NED_W).isFinite());
}

TEST(BootMilliseconds, WrapAroundAndStillHaveAnAge) {
  const Time before = Time(Duration(4'294'967'295ms));
  EXPECT_EQ(bootMilliseconds(before), 4'294'967'295U);
  EXPECT_EQ(bootMilliseconds(before + 1ms), 0U);
  EXPECT_EQ(ageOf(bootMilliseconds(before), before + 150ms), 150ms);
  EXPECT_EQ(ageOf(bootMilliseconds(before + 150ms), before), -150ms);
}

}  // namespace
}  // namespace nanomap
