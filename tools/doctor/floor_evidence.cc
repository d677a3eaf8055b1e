#include "tools/doctor/floor_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/view.h"
#include "tools/doctor/frame_pairs.h"

namespace nanomap::doctor {
namespace {

constexpr std::size_t kFrames = 5;
constexpr std::size_t kPoints = 2000;      ///< looked at of a frame, about
constexpr std::size_t kLeastPoints = 100;  ///< with a return, for it to be a picture of anything

constexpr double kLeastShare = 0.1;  ///< of the returns, on a plane that is level already
constexpr double kLeastShareOfMistake = 0.25;
constexpr double kMostBehindOfMistake = 0.02;  ///< of the returns: nothing is under a floor
constexpr double kClearlyLarger = 2.0;

/// Cosine between plane's normal and line of sight: a camera that looks ahead sees a floor at a slant, a wall ahead
/// not.
constexpr double kMostFacing = 0.77;  // 40 degrees

/// Not steeper than a floor may be, or seem to be if the camera is tilted a little.
bool isLevel(const Vec3& normal_W) {
  constexpr double kMostSlope = 0.82;  // 35 degrees
  return normal_W.z() >= kMostSlope;
}

/// Large and clear enough to say that the mount is wrong.
bool showsMistake(const Plane& plane) {
  return plane.share >= kLeastShareOfMistake && plane.share_behind <= kMostBehindOfMistake;
}

bool isFloor(const Plane& plane) {
  constexpr double kLevel = 0.996;  // 5 degrees
  return plane.share >= kLeastShare && (plane.normal.z() >= kLevel || showsMistake(plane));
}

/// Points that the camera sees, from it, in the axes of W.
std::vector<Vec3> pointsOf(const DepthImage& image, const CameraModel& camera, const Quat& R_W_C) {
  // Not a divisor of usual widths, so that it walks through all columns.
  const std::size_t step = std::max<std::size_t>(image.pixels.size() / kPoints, 1) | 1U;
  std::vector<Vec3> points;
  for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += step) {
    const std::uint16_t raw = image.pixels[pixel];
    if (camera.classify(raw) != DepthReading::kInRange) continue;
    points.emplace_back(R_W_C * camera.deproject(pixel, raw).cast<double>());
  }
  return points;
}

FloorEvidence evidenceOf(const DepthImage& image, const CameraModel& camera, const Quat& R_W_C) {
  using Kind = FloorEvidence::Kind;
  const std::vector<Vec3> points = pointsOf(image, camera, R_W_C);
  if (points.size() < kLeastPoints) return {};

  const Vec3 sight_W = R_W_C * Vec3::UnitZ();
  const auto below = largestPlane(points, isLevel);
  const auto elsewhere = largestPlane(points, [&](const Vec3& normal_W) {
    return !isLevel(normal_W) && std::abs(normal_W.dot(sight_W)) <= kMostFacing;
  });
  const bool floor_below = below && isFloor(*below);
  const bool floor_elsewhere =
      elsewhere && showsMistake(*elsewhere) && (!floor_below || elsewhere->share > below->share);
  if (!floor_elsewhere) return floor_below ? FloorEvidence{Kind::kBelow, *below, R_W_C} : FloorEvidence{Kind::kNoFloor};
  const bool clearly = !floor_below || elsewhere->share >= kClearlyLarger * below->share;
  return {clearly ? Kind::kElsewhere : Kind::kAmbiguous, *elsewhere, R_W_C};
}

}  // namespace

Quat FloorEvidence::turnToLevel_W() const {
  constexpr double kUpOrDown = 0.1;  // a line of sight that has no heading
  const Quat least = Quat::FromTwoVectors(plane.normal, Vec3::UnitZ());
  const Vec3 sight_W = R_W_C * Vec3::UnitZ();
  const Vec3 turned_W = least * sight_W;
  if (std::hypot(sight_W.x(), sight_W.y()) < kUpOrDown || std::hypot(turned_W.x(), turned_W.y()) < kUpOrDown) {
    return least;
  }
  const double back_rad = std::atan2(sight_W.y(), sight_W.x()) - std::atan2(turned_W.y(), turned_W.x());
  return Eigen::AngleAxisd(back_rad, Vec3::UnitZ()) * least;
}

FloorEvidence floorEvidence(const Heard& heard, const CameraModel& camera, Duration max_pose_gap) {
  const PoseBuffer poses = poseBufferOf(heard, max_pose_gap);
  const std::size_t step = std::max<std::size_t>(heard.frames.size() / kFrames, 1);
  std::vector<FloorEvidence> all;
  for (std::size_t i = 0; i < heard.frames.size(); i += step) {
    const DepthImage& image = heard.frames[i].image;
    const PoseBuffer::Lookup pose = poses.interpolate(image.stamp);
    if (pose.status != PoseBuffer::LookupStatus::kFound || faultOf(image, camera)) continue;
    all.push_back(evidenceOf(image, camera, pose.T_W_B.rotation * camera.parameters().T_B_C.rotation));
  }
  if (all.empty()) return {};
  const auto alike = [&](const FloorEvidence& one) { return std::ranges::count(all, one.kind, &FloorEvidence::kind); };
  const auto kind = std::ranges::max_element(all, {}, alike)->kind;
  std::erase_if(all, [&](const FloorEvidence& one) { return one.kind != kind; });
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, middle, {}, [](const FloorEvidence& one) { return one.plane.normal.z(); });
  return *middle;
}

}  // namespace nanomap::doctor
