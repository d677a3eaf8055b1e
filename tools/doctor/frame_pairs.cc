#include "tools/doctor/frame_pairs.h"

#include <algorithm>

namespace nanomap::doctor {
namespace {

constexpr std::size_t kMaxPairs = 40;
constexpr double kLeastMove_m = 0.4;
constexpr double kMostMove_m = 3.0;
constexpr double kLeastTurn_rad = 0.15;
constexpr double kMostTurn_rad = 0.6;
constexpr Duration kLongestWait = std::chrono::seconds(3);

enum class Motion { kTooLittle, kEnough, kTooMuch };

Motion motionBetween(const Pose& T_W_A, const Pose& T_W_B) {
  const double move_m = (T_W_A.translation_m - T_W_B.translation_m).norm();
  const double turn_rad = T_W_A.rotation.angularDistance(T_W_B.rotation);
  if (move_m > kMostMove_m || turn_rad > kMostTurn_rad) return Motion::kTooMuch;
  return move_m >= kLeastMove_m || turn_rad >= kLeastTurn_rad ? Motion::kEnough : Motion::kTooLittle;
}

struct PlacedFrame {
  const DepthImage* image = nullptr;
  PoseBuffer::Lookup pose;
};

std::vector<PlacedFrame> placedFrames(const Heard& heard, const PoseBuffer& poses, const CameraModel& camera,
                                      Duration stamp_shift) {
  std::vector<PlacedFrame> placed;
  for (const DepthInput& frame : heard.frames) {
    if (frame.image.width_px != camera.width() || frame.image.height_px != camera.height()) continue;
    const auto pose = poses.interpolate(frame.image.stamp + stamp_shift);
    if (pose.status == PoseBuffer::LookupStatus::kFound) placed.push_back({&frame.image, pose});
  }
  return placed;
}

}  // namespace

PoseBuffer poseBufferOf(const Heard& heard, Duration max_gap) {
  PoseBuffer poses(std::max<std::size_t>(heard.poses.size(), 1), max_gap);
  for (const BodyPose& pose : heard.poses) (void)poses.insert(pose);  // what is wrong with poses is another question
  return poses;
}

std::vector<FramePair> movedPairs(const Heard& heard, const PoseBuffer& poses, const CameraModel& camera,
                                  Duration stamp_shift) {
  const std::vector<PlacedFrame> frames = placedFrames(heard, poses, camera, stamp_shift);
  std::vector<FramePair> pairs;
  for (auto from = frames.begin(); from != frames.end(); ++from) {
    for (auto to = from + 1; to != frames.end(); ++to) {
      if (to->image->stamp - from->image->stamp > kLongestWait || to->pose.epoch != from->pose.epoch) break;
      const Motion motion = motionBetween(from->pose.T_W_B, to->pose.T_W_B);
      if (motion == Motion::kTooLittle) continue;
      if (motion == Motion::kEnough) pairs.push_back({from->image, to->image, from->pose.T_W_B, to->pose.T_W_B});
      break;
    }
  }
  std::vector<FramePair> spread;
  const std::size_t step = std::max<std::size_t>((pairs.size() + kMaxPairs - 1) / kMaxPairs, 1);
  for (std::size_t i = 0; i < pairs.size(); i += step) spread.push_back(pairs[i]);
  return spread;
}

}  // namespace nanomap::doctor
