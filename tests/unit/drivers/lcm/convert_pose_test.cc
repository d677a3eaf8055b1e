#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "tests/unit/drivers/example_log.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

body_pose_t bodyPoseMessage() {
  body_pose_t message{};
  message.utime = 1'000'000;
  message.sequence = 7;
  message.epoch = 2;
  message.world_from_body.rotation[0] = 1.0;
  return message;
}

TEST(ToBodyPose, PythonMessageKeepsEveryValue) {
  const auto bytes = exampleMessages("RECOGNISABLE_POSE");
  ASSERT_EQ(bytes.size(), 1U);
  const auto pose = std::get<BodyPose>(toBodyPose(std::get<body_pose_t>(decode<body_pose_t>(bytes.front()))));
  EXPECT_EQ(pose.stamp, Time(milliseconds(1000)));
  EXPECT_EQ(pose.sequence, 7U);
  EXPECT_EQ(pose.epoch, 2U);
  EXPECT_EQ(pose.T_W_B.translation_m, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(pose.T_W_B.rotation.coeffs(), Quat(0.5, 0.5, -0.5, 0.5).coeffs());
  ASSERT_TRUE(pose.increment.has_value());
  EXPECT_EQ(pose.increment->interval, milliseconds(10));
  EXPECT_EQ(pose.increment->covariance_W_m2, (Mat3() << 1, 2, 3, 4, 5, 6, 7, 8, 9).finished());
}

TEST(ToBodyPose, NegativeHeaderFieldsAreNamed) {
  body_pose_t message = bodyPoseMessage();
  message.utime = -1;
  EXPECT_EQ(std::get<ConvertFault>(toBodyPose(message)), ConvertFault::kBadStamp);
  message = bodyPoseMessage();
  message.sequence = -1;
  EXPECT_EQ(std::get<ConvertFault>(toBodyPose(message)), ConvertFault::kBadSequence);
  message = bodyPoseMessage();
  message.epoch = -1;
  EXPECT_EQ(std::get<ConvertFault>(toBodyPose(message)), ConvertFault::kBadEpoch);
}

TEST(ToBodyPose, NonFiniteAndNonUnitPassThrough) {
  body_pose_t message = bodyPoseMessage();
  message.world_from_body.translation[1] = kNaN;
  message.world_from_body.rotation[0] = 2.0;
  const auto pose = std::get<BodyPose>(toBodyPose(message));
  EXPECT_TRUE(std::isnan(pose.T_W_B.translation_m.y()));
  EXPECT_EQ(pose.T_W_B.rotation.w(), 2.0);
}

TEST(ToBodyPose, UnusableIncrementIsLeftOutAndThePoseKept) {
  body_pose_t message = bodyPoseMessage();
  message.has_increment_covariance = 1;
  message.increment_since_utime = std::numeric_limits<std::int64_t>::min();
  EXPECT_FALSE(std::get<BodyPose>(toBodyPose(message)).increment.has_value());
  message.increment_since_utime = 900'000;
  message.has_increment_covariance = 0;
  EXPECT_FALSE(std::get<BodyPose>(toBodyPose(message)).increment.has_value());
}

TEST(ToBodyPose, WhatWasMadeOfAPoseGivesItBack) {
  BodyPose pose;
  pose.stamp = Time(milliseconds(1234));
  pose.epoch = 3;
  pose.sequence = 99;
  pose.T_W_B = {Quat(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())), {4.0, 5.0, 6.0}};
  pose.increment = DriftIncrement{(Mat3() << 2, 1, 0, 1, 3, 0, 0, 0, 4).finished(), milliseconds(10)};
  const auto back = std::get<BodyPose>(toBodyPose(toMessage(pose, std::nullopt)));
  EXPECT_EQ(back.stamp, pose.stamp);
  EXPECT_EQ(back.epoch, pose.epoch);
  EXPECT_EQ(back.sequence, pose.sequence);
  EXPECT_EQ(back.T_W_B.rotation.coeffs(), pose.T_W_B.rotation.coeffs());
  EXPECT_EQ(back.T_W_B.translation_m, pose.T_W_B.translation_m);
  ASSERT_TRUE(back.increment.has_value());
  EXPECT_EQ(back.increment->covariance_W_m2, pose.increment->covariance_W_m2);
  EXPECT_EQ(back.increment->interval, pose.increment->interval);
}

TEST(BodyPoseMessage, UnknownMotionIsNaNAndKnownIsKept) {
  EXPECT_TRUE(std::isnan(toMessage(BodyPose{}, std::nullopt).velocity[0]));
  const body_pose_t known = toMessage(BodyPose{}, BodyMotion{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  EXPECT_EQ(known.velocity[2], 3.0);
  EXPECT_EQ(known.angular_rate[0], 4.0);
  EXPECT_EQ(known.acceleration[1], 8.0);
}

TEST(ToBodyMotion, WithoutVelocityThereIsNone) { EXPECT_FALSE(toBodyMotion(toMessage(BodyPose{}, std::nullopt))); }

TEST(ToBodyMotion, UnknownAccelerationIsNone) {
  const body_pose_t message = toMessage(BodyPose{}, BodyMotion{{1, 2, 3}, {4, 5, 6}, Vec3::Constant(kNaN)});
  const auto motion = toBodyMotion(message);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->velocity_W_m_s, Vec3(1, 2, 3));
  EXPECT_EQ(motion->angular_rate_B_rad_s, Vec3(4, 5, 6));
  EXPECT_EQ(motion->acceleration_W_m_s2, Vec3::Zero());
}

TEST(ToBodyMotion, HalfOfAValuePassesThrough) {
  const auto motion = toBodyMotion(toMessage(BodyPose{}, BodyMotion{{1, kNaN, 3}, {4, 5, 6}, {kNaN, 8, 9}}));
  ASSERT_TRUE(motion) << "core is to judge it";
  EXPECT_TRUE(std::isnan(motion->velocity_W_m_s.y()));
  EXPECT_TRUE(std::isnan(motion->acceleration_W_m_s2.x()));
}

/// A body that has turned left by 90 degrees, nose to local +y, as both conventions say it.
bot_core::pose_t turnedLeft(BodyConvention convention) {
  const double half = std::sqrt(0.5);
  bot_core::pose_t message{};
  message.utime = 5;
  message.pos[2] = 10.0;
  if (convention == BodyConvention::kFlu) {
    message.orientation[0] = half;
    message.orientation[3] = half;
  } else {  // belly-down axes: columns are forward +y, right +x, down -z
    message.orientation[1] = half;
    message.orientation[2] = half;
  }
  return message;
}

class PoseConvention : public ::testing::TestWithParam<BodyConvention> {};

TEST_P(PoseConvention, BodyIsForwardLeftUpAfterwards) {
  const auto pose = std::get<BodyPose>(toBodyPose(turnedLeft(GetParam()), GetParam(), 42));
  EXPECT_TRUE((pose.T_W_B * Vec3::UnitX()).isApprox(Vec3(0.0, 1.0, 10.0), 1e-12)) << "forward";
  EXPECT_TRUE((pose.T_W_B * Vec3::UnitY()).isApprox(Vec3(-1.0, 0.0, 10.0), 1e-12)) << "left";
  EXPECT_TRUE((pose.T_W_B * Vec3::UnitZ()).isApprox(Vec3(0.0, 0.0, 11.0), 1e-12)) << "up";
  EXPECT_EQ(pose.sequence, 42U);
  EXPECT_EQ(pose.epoch, 0U);
}

TEST_P(PoseConvention, MessageOfAPoseGivesItBack) {
  BodyPose pose;
  pose.stamp = Time(milliseconds(1));
  pose.T_W_B = {Quat(Eigen::AngleAxisd(std::numbers::pi / 5, Vec3(3, -1, 2).normalized())), {1.0, 2.0, 3.0}};
  const auto back = std::get<BodyPose>(toBodyPose(toPoseMessage(pose, GetParam()), GetParam(), 0));
  EXPECT_TRUE(back.T_W_B.rotation.toRotationMatrix().isApprox(pose.T_W_B.rotation.toRotationMatrix(), 1e-12));
  EXPECT_EQ(back.T_W_B.translation_m, pose.T_W_B.translation_m);
  EXPECT_EQ(back.stamp, pose.stamp);
}

TEST_P(PoseConvention, BadStampIsNamedAndNaNPassesThrough) {
  bot_core::pose_t message = turnedLeft(GetParam());
  message.orientation[1] = kNaN;
  EXPECT_FALSE(std::get<BodyPose>(toBodyPose(message, GetParam(), 0)).T_W_B.rotation.coeffs().allFinite());
  message.utime = -5;
  EXPECT_EQ(std::get<ConvertFault>(toBodyPose(message, GetParam(), 0)), ConvertFault::kBadStamp);
}

INSTANTIATE_TEST_SUITE_P(Both, PoseConvention, ::testing::Values(BodyConvention::kFlu, BodyConvention::kFrd),
                         [](const auto& param) { return param.param == BodyConvention::kFlu ? "Flu" : "Frd"; });

TEST(ToCorrection, WhatWasMadeOfACorrectionGivesItBack) {
  Correction correction{.epoch = 1, .sequence = 12, .poses = {}};
  for (int i = 0; i < 3; ++i) {
    correction.poses.push_back({Time(milliseconds(500 * i)), {Quat::Identity(), {1.0 * i, 0.0, 0.0}}});
  }
  const auto back = std::get<Correction>(toCorrection(toMessage(correction, Time(milliseconds(2000)))));
  EXPECT_EQ(back.epoch, 1U);
  EXPECT_EQ(back.sequence, 12U);
  ASSERT_EQ(back.poses.size(), 3U);
  EXPECT_EQ(back.poses[2].stamp, Time(milliseconds(1000)));
  EXPECT_EQ(back.poses[2].T_W_B.translation_m, Vec3(2.0, 0.0, 0.0));
}

TEST(ToCorrection, EmptyWindowPassesThrough) {
  EXPECT_TRUE(std::get<Correction>(toCorrection(pose_correction_t{})).poses.empty());
}

TEST(ToCorrection, FaultsAreNamed) {
  pose_correction_t message{};
  message.num_poses = 2;
  message.poses.resize(2);
  message.poses[1].utime = -1;
  EXPECT_EQ(std::get<ConvertFault>(toCorrection(message)), ConvertFault::kBadStamp);
  message.epoch = -1;
  EXPECT_EQ(std::get<ConvertFault>(toCorrection(message)), ConvertFault::kBadEpoch);
  message.sequence = -1;
  EXPECT_EQ(std::get<ConvertFault>(toCorrection(message)), ConvertFault::kBadSequence);
}

}  // namespace
}  // namespace nanomap
