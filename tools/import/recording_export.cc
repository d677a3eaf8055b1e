#include "tools/import/recording_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "drivers/lcm/convert.h"
#include "tools/import/depth_png.h"

namespace nanomap {
namespace {

constexpr const char* kCameraName = "depth";

/// A log says when a message came. An image takes longer than a pose, so that at the 100 Hz of most estimators a pose
/// newer than the image is there before it.
constexpr Duration kPoseLatency = std::chrono::milliseconds(2);
constexpr Duration kImageLatency = std::chrono::milliseconds(20);

/// Velocity and rate from the neighbours of pose `i`; empty for a lone pose.
std::optional<BodyMotion> motionAt(const std::vector<BodyPose>& poses, std::size_t i) {
  const BodyPose& from = poses[i == 0 ? 0 : i - 1];
  const BodyPose& to = poses[std::min(i + 1, poses.size() - 1)];
  const double interval_s = toSeconds(to.stamp - from.stamp);
  if (interval_s <= 0.0) return std::nullopt;

  BodyMotion motion;
  motion.velocity_W_m_s = (to.T_W_B.translation_m - from.T_W_B.translation_m) / interval_s;
  const Eigen::AngleAxisd turn(from.T_W_B.rotation.conjugate() * to.T_W_B.rotation);
  motion.angular_rate_B_rad_s = turn.axis() * turn.angle() / interval_s;
  // Second differences of measured poses are noise.
  motion.acceleration_W_m_s2.setConstant(std::numeric_limits<double>::quiet_NaN());
  return motion;
}

std::vector<BodyPose> bodyPoses(const std::vector<RecordedPose>& recorded, const Pose& T_B_C) {
  const Pose T_C_B = T_B_C.inverse();
  std::vector<BodyPose> poses;
  poses.reserve(recorded.size());
  for (const RecordedPose& pose : recorded) {
    poses.push_back({.stamp = pose.stamp,
                     .T_W_B = pose.T_W_C * T_C_B,
                     .epoch = 0,
                     .sequence = poses.size(),
                     .increment = std::nullopt});
  }
  return poses;
}

DepthImage readImage(const RecordedImage& recorded, const CameraParameters& camera) {
  DepthPng png = readDepthPng(recorded.file);
  if (png.width_px != camera.width_px || png.height_px != camera.height_px) {
    throw std::runtime_error(fmt::format("{}: {}x{} px, but the camera has {}x{}", recorded.file.string(), png.width_px,
                                         png.height_px, camera.width_px, camera.height_px));
  }
  return {recorded.stamp, recorded.sequence, png.width_px, png.height_px, camera.depth_unit_m, std::move(png.pixels)};
}

}  // namespace

ExportCounts writeRecording(const Recording& recording, const CameraParameters& camera, const LcmParameters& channels,
                            LogWriter& log) {
  const std::vector<BodyPose> poses = bodyPoses(recording.poses, camera.T_B_C);
  ExportCounts counts;
  const auto writePosesUntil = [&](Time log_stamp) {
    for (; counts.poses < poses.size() && poses[counts.poses].stamp + kPoseLatency <= log_stamp; ++counts.poses) {
      const BodyPose& pose = poses[counts.poses];
      log.write(channels.pose_channel, pose.stamp + kPoseLatency, toMessage(pose, motionAt(poses, counts.poses)));
    }
  };

  Time start = recording.images.empty() ? Time{} : recording.images.front().stamp;
  if (!poses.empty()) start = std::min(start, poses.front().stamp);
  log.write(channels.camera_channel, start, toMessage(camera, kCameraName, start));

  for (const RecordedImage& recorded : recording.images) {
    writePosesUntil(recorded.stamp + kImageLatency);
    log.write(channels.depth_channel, recorded.stamp + kImageLatency,
              toMessage(readImage(recorded, camera), kCameraName, DepthCompression::kBlosc));
    ++counts.images;
    const bool covered =
        !poses.empty() && poses.front().stamp <= recorded.stamp && recorded.stamp <= poses.back().stamp;
    if (!covered) ++counts.images_without_pose;
  }
  writePosesUntil(Time::max());
  return counts;
}

}  // namespace nanomap
