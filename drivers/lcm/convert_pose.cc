#include <cmath>
#include <limits>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using RowMajorMat3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// R between FLU and FRD, in either direction: half a turn about x.
const Quat& halfTurnAboutX() {
  static const Quat half_turn(0.0, 1.0, 0.0, 0.0);
  return half_turn;
}

Vec3 toVec3(const double (&xyz)[3]) { return {xyz[0], xyz[1], xyz[2]}; }
Quat toQuat(const double (&wxyz)[4]) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

void store(const Vec3& from, double (&xyz)[3]) {
  for (int i = 0; i < 3; ++i) xyz[i] = from[i];
}

void store(const Quat& from, double (&wxyz)[4]) {
  wxyz[0] = from.w();
  wxyz[1] = from.x();
  wxyz[2] = from.y();
  wxyz[3] = from.z();
}

bool isUnknown(const Vec3& value) { return value.array().isNaN().all(); }

std::optional<DriftIncrement> toIncrement(const body_pose_t& message, Time stamp) {
  const Converted<Time> since = timeFromUtime(message.increment_since_utime);
  if (!message.has_increment_covariance || !std::holds_alternative<Time>(since)) return std::nullopt;
  return DriftIncrement{Eigen::Map<const RowMajorMat3>(message.increment_covariance), stamp - std::get<Time>(since)};
}

}  // namespace

Pose toPose(const transform_t& message) { return {toQuat(message.rotation), toVec3(message.translation)}; }

Converted<BodyPose> toBodyPose(const body_pose_t& message) {
  const Converted<Time> stamp = timeFromUtime(message.utime);
  if (const auto* fault = std::get_if<ConvertFault>(&stamp)) return *fault;
  if (message.sequence < 0) return ConvertFault::kBadSequence;
  if (message.epoch < 0) return ConvertFault::kBadEpoch;

  BodyPose pose;
  pose.stamp = std::get<Time>(stamp);
  pose.T_W_B = toPose(message.world_from_body);
  pose.epoch = static_cast<std::uint32_t>(message.epoch);
  pose.sequence = static_cast<std::uint64_t>(message.sequence);
  pose.increment = toIncrement(message, pose.stamp);
  return pose;
}

Converted<BodyPose> toBodyPose(const bot_core::pose_t& message, BodyConvention convention, std::uint64_t sequence) {
  const Converted<Time> stamp = timeFromUtime(message.utime);
  if (const auto* fault = std::get_if<ConvertFault>(&stamp)) return *fault;

  BodyPose pose;
  pose.stamp = std::get<Time>(stamp);
  pose.T_W_B = {toQuat(message.orientation), toVec3(message.pos)};
  if (convention == BodyConvention::kFrd) pose.T_W_B.rotation = pose.T_W_B.rotation * halfTurnAboutX();
  pose.sequence = sequence;
  return pose;
}

std::optional<BodyMotion> toBodyMotion(const body_pose_t& message) {
  BodyMotion motion{toVec3(message.velocity), toVec3(message.angular_rate), toVec3(message.acceleration)};
  if (isUnknown(motion.velocity_W_m_s)) return std::nullopt;
  if (isUnknown(motion.acceleration_W_m_s2)) motion.acceleration_W_m_s2.setZero();
  return motion;
}

Converted<Correction> toCorrection(const pose_correction_t& message) {
  if (message.sequence < 0) return ConvertFault::kBadSequence;
  if (message.epoch < 0) return ConvertFault::kBadEpoch;

  Correction correction;
  correction.epoch = static_cast<std::uint32_t>(message.epoch);
  correction.sequence = static_cast<std::uint64_t>(message.sequence);
  correction.poses.reserve(message.poses.size());
  for (const stamped_transform_t& corrected : message.poses) {
    const Converted<Time> stamp = timeFromUtime(corrected.utime);
    if (const auto* fault = std::get_if<ConvertFault>(&stamp)) return *fault;
    correction.poses.push_back({std::get<Time>(stamp), toPose(corrected.transform)});
  }
  return correction;
}

transform_t toMessage(const Pose& T_A_B) {
  transform_t message{};
  store(T_A_B.translation_m, message.translation);
  store(T_A_B.rotation, message.rotation);
  return message;
}

body_pose_t toMessage(const BodyPose& pose, const std::optional<BodyMotion>& motion) {
  const Vec3 unknown = Vec3::Constant(kUnknown);
  body_pose_t message{};
  message.utime = utimeFromTime(pose.stamp);
  message.sequence = static_cast<std::int64_t>(pose.sequence);
  message.epoch = static_cast<std::int32_t>(pose.epoch);
  message.world_from_body = toMessage(pose.T_W_B);
  store(motion ? motion->velocity_W_m_s : unknown, message.velocity);
  store(motion ? motion->angular_rate_B_rad_s : unknown, message.angular_rate);
  store(motion ? motion->acceleration_W_m_s2 : unknown, message.acceleration);
  message.has_increment_covariance = pose.increment.has_value() ? 1 : 0;
  if (pose.increment) {
    message.increment_since_utime = utimeFromTime(pose.stamp - pose.increment->interval);
    Eigen::Map<RowMajorMat3>(message.increment_covariance) = pose.increment->covariance_W_m2;
  }
  return message;
}

pose_correction_t toMessage(const Correction& correction, Time computed) {
  pose_correction_t message{};
  message.utime = utimeFromTime(computed);
  message.sequence = static_cast<std::int64_t>(correction.sequence);
  message.epoch = static_cast<std::int32_t>(correction.epoch);
  message.num_poses = static_cast<std::int32_t>(correction.poses.size());
  message.poses.reserve(correction.poses.size());
  for (const CorrectedPose& pose : correction.poses) {
    message.poses.push_back({utimeFromTime(pose.stamp), toMessage(pose.T_W_B)});
  }
  return message;
}

bot_core::pose_t toPoseMessage(const BodyPose& pose, BodyConvention convention) {
  const Quat& R_W_B = pose.T_W_B.rotation;
  const Vec3 unknown = Vec3::Constant(kUnknown);
  bot_core::pose_t message{};
  message.utime = utimeFromTime(pose.stamp);
  store(pose.T_W_B.translation_m, message.pos);
  store(convention == BodyConvention::kFrd ? R_W_B * halfTurnAboutX() : R_W_B, message.orientation);
  store(unknown, message.vel);
  store(unknown, message.rotation_rate);
  store(unknown, message.accel);
  return message;
}

}  // namespace nanomap
