#include "firmware_app/pipeline/message_intake.h"

#include <gtest/gtest.h>

#include <vector>

namespace nanomap {
namespace {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, message.getEncodedSize()), message.getEncodedSize());
  return bytes;
}

bot_core::pose_t poseMessage(std::int64_t utime_us, double x_m) {
  BodyPose pose;
  pose.stamp = Time(std::chrono::microseconds(utime_us));
  pose.T_W_B.translation_m = {x_m, 0.0, 0.0};
  return toPoseMessage(pose, BodyConvention::kFlu);
}

bot_core::image_t rawImage() {
  bot_core::image_t image{};
  image.utime = 5;
  image.width = 2;
  image.height = 1;
  image.row_stride = 4;
  image.pixelformat = bot_core::image_t::PIXEL_FORMAT_LE_GRAY16;
  image.data = {0x10, 0x27, 0x20, 0x4E};
  image.size = 4;
  return image;
}

template <class Value>
Value taken(MessageIntake& intake, InputKind kind, const std::vector<std::uint8_t>& bytes) {
  return std::get<Value>(std::get<Input>(intake.read(kind, bytes)));
}

TEST(MessageIntake, KnowsItsConfiguredChannels) {
  LcmParameters lcm;
  lcm.pose_channel = "VIO";
  const MessageIntake intake(lcm);
  EXPECT_EQ(intake.kindOf("VIO"), InputKind::kPose);
  EXPECT_EQ(intake.kindOf(lcm.depth_channel), InputKind::kDepth);
  EXPECT_EQ(intake.kindOf(lcm.camera_channel), InputKind::kCamera);
  EXPECT_EQ(intake.kindOf(lcm.correction_channel), InputKind::kCorrection);
  EXPECT_EQ(intake.kindOf("POSE_BODY"), std::nullopt);
  EXPECT_EQ(intake.kindOf(""), std::nullopt);
}

TEST(MessageIntake, BodyPoseKeepsItsOwnEpochAndSequence) {
  BodyPose pose;
  pose.epoch = 3;
  pose.sequence = 77;
  MessageIntake intake{LcmParameters{}};
  const auto read = taken<PoseInput>(intake, InputKind::kPose, encoded(toMessage(pose, std::nullopt))).pose;
  EXPECT_EQ(read.epoch, 3U);
  EXPECT_EQ(read.sequence, 77U);
}

TEST(MessageIntake, PoseWithoutEpochAndSequenceGetsBoth) {
  MessageIntake intake{LcmParameters{}};
  const auto first = taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(0, 0.0))).pose;
  const auto second = taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(10'000, 0.1))).pose;
  const auto jumped = taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(20'000, 9.0))).pose;
  EXPECT_EQ(first.sequence, 0U);
  EXPECT_EQ(second.sequence, 1U);
  EXPECT_EQ(second.epoch, 0U);
  EXPECT_EQ(jumped.epoch, 1U);
}

TEST(MessageIntake, JumpThatTheEstimatorHidesRaisesTheEpochOfAllThatFollows) {
  MessageIntake intake{LcmParameters{}};
  BodyPose pose;
  pose.epoch = 3;
  EXPECT_EQ(taken<PoseInput>(intake, InputKind::kPose, encoded(toMessage(pose, std::nullopt))).pose.epoch, 3U);
  pose.stamp += std::chrono::milliseconds(10);
  pose.T_W_B.translation_m.x() = 1.0;
  EXPECT_EQ(taken<PoseInput>(intake, InputKind::kPose, encoded(toMessage(pose, std::nullopt))).pose.epoch, 4U);

  goal_t goal{};
  goal.epoch = 3;
  EXPECT_EQ(taken<Goal>(intake, InputKind::kGoal, encoded(goal)).epoch, 4U);
  Correction correction;
  correction.epoch = 3;
  const auto message = encoded(toMessage(correction, pose.stamp));
  EXPECT_EQ(taken<Correction>(intake, InputKind::kCorrection, message).epoch, 4U);
}

TEST(MessageIntake, GoalThatIsSentAgainAfterAHiddenJumpStaysInItsWorld) {
  MessageIntake intake{LcmParameters{}};
  const auto worldOf = [&](const goal_t& goal) { return taken<Goal>(intake, InputKind::kGoal, encoded(goal)).epoch; };
  goal_t goal{};
  goal.sequence = 7;
  goal.position[0] = 50.0;
  (void)taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(0, 0.0)));
  EXPECT_EQ(worldOf(goal), 0U);
  (void)taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(10'000, 20.0)));
  EXPECT_EQ(worldOf(goal), 0U) << "20 m off where it was meant";
  goal.top_speed = 3.0;
  EXPECT_EQ(worldOf(goal), 0U);
  goal.sequence = 8;
  EXPECT_EQ(worldOf(goal), 1U) << "it is another one";
  EXPECT_EQ(worldOf(goal), 1U);
  goal.position[0] = 30.0;
  EXPECT_EQ(worldOf(goal), 1U);
}

TEST(MessageIntake, PoseConventionIsTheConfiguredOne) {
  LcmParameters lcm;
  lcm.pose_t_body = BodyConvention::kFrd;
  MessageIntake intake{lcm};
  const auto read = taken<PoseInput>(intake, InputKind::kPose, encoded(poseMessage(0, 0.0))).pose;
  EXPECT_LT((read.T_W_B.rotation * Vec3::UnitZ() + Vec3::UnitZ()).norm(), 1e-12);
}

TEST(MessageIntake, DepthIsRecognisedByItsType) {
  MessageIntake intake{LcmParameters{}};
  const auto lone = taken<DepthInput>(intake, InputKind::kDepth, encoded(rawImage()));
  EXPECT_EQ(lone.image.pixels, (std::vector<std::uint16_t>{10'000, 20'000}));
  EXPECT_EQ(lone.image.sequence, 0U);
  EXPECT_EQ(lone.camera, "");

  bot_core::images_t set{};
  set.utime = 6;
  set.n_images = 1;
  set.image_types = {bot_core::images_t::DEPTH_MM};
  set.images = {rawImage()};
  const auto from_set = taken<DepthInput>(intake, InputKind::kDepth, encoded(set));
  EXPECT_EQ(from_set.image.pixels, lone.image.pixels);
  EXPECT_EQ(from_set.image.sequence, 1U);

  DepthImage image = lone.image;
  image.sequence = 42;
  const auto own =
      taken<DepthInput>(intake, InputKind::kDepth, encoded(toMessage(image, "front", DepthCompression::kBlosc)));
  EXPECT_EQ(own.image.pixels, lone.image.pixels);
  EXPECT_EQ(own.image.sequence, 42U);
  EXPECT_EQ(own.camera, "front");
}

TEST(MessageIntake, AnotherTypeIsAFault) {
  MessageIntake intake{LcmParameters{}};
  const auto outcome = intake.read(InputKind::kDepth, encoded(poseMessage(0, 0.0)));
  EXPECT_EQ(std::get<DecodeFault>(outcome), DecodeFault::kWrongType);
  EXPECT_EQ(std::get<DecodeFault>(intake.read(InputKind::kCamera, {})), DecodeFault::kTruncated);
}

TEST(MessageIntake, WhatNoValueCanHoldIsAFault) {
  MessageIntake intake{LcmParameters{}};
  bot_core::pose_t message = poseMessage(0, 0.0);
  message.utime = -1;
  EXPECT_EQ(std::get<ConvertFault>(intake.read(InputKind::kPose, encoded(message))), ConvertFault::kBadStamp);
}

}  // namespace
}  // namespace nanomap
