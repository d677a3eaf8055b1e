#include "firmware_app/pipeline/message_intake.h"

#include <utility>

namespace nanomap {
namespace {

using Outcome = MessageIntake::Outcome;

/// Decodes a message, converts it to a value of core, and wraps that into an input.
template <class Message, class Convert, class Wrap>
Outcome take(Bytes bytes, Convert&& convert, Wrap&& wrap) {
  auto decoded = decode<Message>(bytes);
  if (const auto* fault = std::get_if<DecodeFault>(&decoded)) return *fault;
  const Message& message = std::get<Message>(decoded);
  auto converted = convert(message);
  if (const auto* fault = std::get_if<ConvertFault>(&converted)) return *fault;
  return Input(wrap(message, std::move(std::get<0>(converted))));
}

constexpr auto kOfUnnamedCamera = [](const auto&, DepthImage image) { return DepthInput{{}, std::move(image), false}; };

}  // namespace

std::string_view toString(InputKind kind) {
  switch (kind) {
    case InputKind::kPose:
      return "poses";
    case InputKind::kCorrection:
      return "corrections";
    case InputKind::kCamera:
      return "camera models";
    case InputKind::kDepth:
      return "depth frames";
    case InputKind::kGoal:
      return "goals";
  }
  return "?";
}

const std::string& channelOf(const LcmParameters& lcm, InputKind kind) {
  switch (kind) {
    case InputKind::kPose:
      return lcm.pose_channel;
    case InputKind::kCorrection:
      return lcm.correction_channel;
    case InputKind::kCamera:
      return lcm.camera_channel;
    case InputKind::kGoal:
      return lcm.goal_channel;
    case InputKind::kDepth:
      break;
  }
  return lcm.depth_channel;
}

std::optional<InputKind> MessageIntake::kindOf(std::string_view channel) const {
  for (std::size_t i = 0; i < kInputKindCount; ++i) {
    const auto kind = static_cast<InputKind>(i);
    if (channel == channelOf(lcm_, kind)) return kind;
  }
  return std::nullopt;
}

Outcome MessageIntake::read(InputKind kind, Bytes message) {
  switch (kind) {
    case InputKind::kPose:
      return readPose(message);
    case InputKind::kCorrection:
      return take<pose_correction_t>(message, toCorrection, [this](const auto&, Correction correction) {
        correction.epoch = epochs_.epochOf(correction.epoch);
        return correction;
      });
    case InputKind::kCamera:
      return take<camera_model_t>(message, toCameraParameters, [](const camera_model_t& m, CameraParameters camera) {
        return CameraInput{m.name, std::move(camera)};
      });
    case InputKind::kGoal:
      return take<goal_t>(message, toGoal, [this](const auto&, Goal goal) {
        goal.epoch = epochOf(goal);
        return goal;
      });
    case InputKind::kDepth:
      break;
  }
  return readDepth(message);
}

std::uint32_t MessageIntake::epochOf(const Goal& sent) {
  const bool again = goal_sent_ && goal_sent_->sequence == sent.sequence && goal_sent_->epoch == sent.epoch &&
                     goal_sent_->position_W_m == sent.position_W_m;
  if (!again) goal_epoch_ = epochs_.epochOf(sent.epoch);
  goal_sent_ = sent;
  return goal_epoch_;
}

Outcome MessageIntake::readPose(Bytes message) {
  if (messageHash(message) != bot_core::pose_t::getHash()) {
    return take<body_pose_t>(
        message, [](const body_pose_t& m) { return toBodyPose(m); },
        [this](const body_pose_t& m, BodyPose pose) {
          pose.epoch = epochs_.assign(pose.stamp, pose.T_W_B, pose.epoch);
          return PoseInput{std::move(pose), toBodyMotion(m)};
        });
  }
  const auto convert = [this](const bot_core::pose_t& m) {
    return toBodyPose(m, lcm_.pose_t_body, unnumbered_poses_++);
  };
  return take<bot_core::pose_t>(message, convert, [this](const auto&, BodyPose pose) {
    pose.epoch = epochs_.assign(pose.stamp, pose.T_W_B);
    return PoseInput{std::move(pose), std::nullopt, false};
  });
}

Outcome MessageIntake::readDepth(Bytes message) {
  const auto convert = [this](const auto& m) { return toDepthImage(m, unnumbered_images_++); };
  const auto hash = messageHash(message);
  if (hash == bot_core::images_t::getHash()) return take<bot_core::images_t>(message, convert, kOfUnnamedCamera);
  if (hash == bot_core::image_t::getHash()) return take<bot_core::image_t>(message, convert, kOfUnnamedCamera);
  return take<depth_image_t>(
      message, [](const depth_image_t& m) { return toDepthImage(m); },
      [](const depth_image_t& m, DepthImage image) {
        return DepthInput{m.camera, std::move(image)};
      });
}

}  // namespace nanomap
