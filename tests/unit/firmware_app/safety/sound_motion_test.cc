#include "firmware_app/safety/sound_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/brake.h"

namespace nanomap {
namespace {

const MotionLimits kLimits;

Decision flown(const Trajectory& brake) {
  Decision decision;
  decision.brake = brake;
  return decision;
}

/// At 5 m/s, braked by `acceleration_m_s2` for `duration_s`.
Decision braking(double acceleration_m_s2, double duration_s) {
  Trajectory brake(Time{}, {{1.0, 2.0, 3.0}, {5.0, 0.0, 0.0}, {-acceleration_m_s2, 0.0, 0.0}});
  brake.append(duration_s, Vec3::Zero());
  return flown(brake);
}

TEST(SoundMotion, EveryBrakeOfThePlannersIs) {
  for (const Vec3& velocity_m_s :
       {Vec3(0.0, 0.0, 0.0), Vec3(0.3, -0.2, 0.1), Vec3(7.0, 0.0, -1.0), Vec3(-9.0, 9.0, 3.0)}) {
    for (const Vec3& acceleration_m_s2 : {Vec3(0.0, 0.0, 0.0), Vec3(2.0, -7.0, 1.0), Vec3(20.0, 5.0, -9.0)}) {
      Trajectory motion(Time{}, {Vec3(3.0, 4.0, 1.0), velocity_m_s, acceleration_m_s2});
      const Vec3 target_m_s2(kLimits.horizontal_m_s2(velocity_m_s.norm()), 0.0, kLimits.vertical_m_s2);
      const double ramp_s = kLimits.rampFor_s((target_m_s2 - acceleration_m_s2).norm());
      motion.append(ramp_s, (target_m_s2 - acceleration_m_s2) / ramp_s);
      motion.append(1.0, Vec3::Zero());
      for (const double after_s : {0.0, 0.1, 0.25}) {
        EXPECT_TRUE(isSound(flown(brakeAfter(motion, after_s, kLimits)), kLimits))
            << velocity_m_s.transpose() << "; " << acceleration_m_s2.transpose() << "; " << after_s;
      }
    }
  }
}

TEST(SoundMotion, EndsAtRest) {
  EXPECT_TRUE(isSound(braking(5.0, 1.0), kLimits));
  EXPECT_FALSE(isSound(braking(5.0, 0.9), kLimits));
  EXPECT_FALSE(isSound(braking(5.0, 1.1), kLimits)) << "flies back";
}

TEST(SoundMotion, KeepsToTheLimitsUnlessItStartsBeyondThem) {
  EXPECT_TRUE(isSound(braking(20.0, 0.25), kLimits)) << "as it was measured";
  Trajectory harder(Time{}, {});
  for (const double jerk_m_s3 : {20.0, -20.0, -20.0, 20.0}) harder.append(1.0, {jerk_m_s3, 0.0, 0.0});
  EXPECT_FALSE(isSound(flown(harder), kLimits));
  Trajectory jerkier(Time{}, {});
  for (const double jerk_m_s3 : {90.0, -90.0, -90.0, 90.0}) jerkier.append(0.05, {jerk_m_s3, 0.0, 0.0});
  EXPECT_FALSE(isSound(flown(jerkier), kLimits));
}

TEST(SoundMotion, IsFinite) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isSound(flown(Trajectory(Time{}, {{kInfinity, 0.0, 0.0}, Vec3::Zero(), Vec3::Zero()})), kLimits));
  for (const double wrong : {kNone, kInfinity}) {
    Trajectory jerk(Time{}, {});
    jerk.append(1.0, {0.0, wrong, 0.0});
    EXPECT_FALSE(isSound(flown(jerk), kLimits));
    Decision heading = braking(5.0, 1.0);
    heading.yaw_W_rad = wrong;
    EXPECT_FALSE(isSound(heading, kLimits));
  }
}

}  // namespace
}  // namespace nanomap
