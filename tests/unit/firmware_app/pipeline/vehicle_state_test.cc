#include "firmware_app/pipeline/vehicle_state.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using std::chrono::milliseconds;

/// Accelerates along x by 2 m/s^2 from rest.
BodyPose poseAt(std::int64_t ms, std::uint32_t epoch = 0) {
  const double elapsed_s = 1e-3 * static_cast<double>(ms);
  BodyPose pose;
  pose.stamp = Time(milliseconds(ms));
  pose.epoch = epoch;
  pose.sequence = static_cast<std::uint64_t>(ms);
  pose.T_W_B.translation_m = {elapsed_s * elapsed_s, 0.0, 1.0};
  return pose;
}

PoseBuffer posesUpTo(std::int64_t last_ms, std::uint32_t epoch = 0) {
  PoseBuffer poses(1000, milliseconds(50));
  for (std::int64_t ms = 0; ms <= last_ms; ms += 10) EXPECT_EQ(poses.insert(poseAt(ms, epoch)), PoseVerdict::kAccepted);
  return poses;
}

TEST(VehicleStateAt, MotionAsSentIsTaken) {
  const VehicleState state = vehicleStateAt(
      poseAt(1000, 3), BodyMotion{.velocity_W_m_s = {1, 2, 3}, .acceleration_W_m_s2 = {4, 5, 6}}, posesUpTo(1000, 3));
  EXPECT_EQ(state.stamp, Time(milliseconds(1000)));
  EXPECT_EQ(state.epoch, 3U);
  EXPECT_EQ(state.sequence, 1000U);
  EXPECT_EQ(state.T_W_B, poseAt(1000).T_W_B);
  EXPECT_EQ(state.velocity_W_m_s, Vec3(1, 2, 3));
  EXPECT_EQ(state.acceleration_W_m_s2, Vec3(4, 5, 6));
}

TEST(VehicleStateAt, VelocityNotSentIsTheMeanOfTheLastTenthOfASecond) {
  const VehicleState state = vehicleStateAt(poseAt(1000), std::nullopt, posesUpTo(1000));
  EXPECT_NEAR(state.velocity_W_m_s.x(), 1.9, 1e-9) << "2 m/s, half of 0.1 s late";
  EXPECT_NEAR(state.velocity_W_m_s.z(), 0.0, 1e-9);
  EXPECT_EQ(state.acceleration_W_m_s2, Vec3::Zero());
}

TEST(VehicleStateAt, TooFewPosesLeaveTheVelocityUnknown) {
  EXPECT_TRUE(vehicleStateAt(poseAt(0), std::nullopt, posesUpTo(0)).velocity_W_m_s.array().isNaN().all());
  EXPECT_TRUE(vehicleStateAt(poseAt(90), std::nullopt, posesUpTo(90)).velocity_W_m_s.array().isNaN().all());
  EXPECT_FALSE(vehicleStateAt(poseAt(100), std::nullopt, posesUpTo(100)).velocity_W_m_s.hasNaN());
}

TEST(VehicleStateAt, NothingIsSubtractedAcrossAJump) {
  PoseBuffer poses = posesUpTo(950);
  const BodyPose jumped = poseAt(1000, 1);
  EXPECT_EQ(poses.insert(jumped), PoseVerdict::kAccepted);
  EXPECT_TRUE(vehicleStateAt(jumped, std::nullopt, poses).velocity_W_m_s.array().isNaN().all());
}

/// Too small to be a jump by its speed: 3 m/s, by the mean alone.
TEST(VehicleStateAt, AStepOfTheEstimatorIsNoVelocity) {
  PoseBuffer poses = posesUpTo(990);
  const auto stepped = [](std::int64_t ms) {
    BodyPose pose = poseAt(ms);
    pose.T_W_B.translation_m.y() += 0.3;
    return pose;
  };
  for (std::int64_t ms = 1000; ms <= 1090; ms += 10) {
    EXPECT_EQ(poses.insert(stepped(ms)), PoseVerdict::kAccepted);
    EXPECT_TRUE(vehicleStateAt(stepped(ms), std::nullopt, poses).velocity_W_m_s.array().isNaN().all()) << ms;
  }
  EXPECT_EQ(poses.insert(stepped(1100)), PoseVerdict::kAccepted);
  EXPECT_NEAR(vehicleStateAt(stepped(1100), std::nullopt, poses).velocity_W_m_s.x(), 2.1, 1e-9);
}

}  // namespace
}  // namespace nanomap
