#include "tests/bench/points/body_points.h"

#include <algorithm>
#include <cassert>
#include <random>
#include <utility>

#include "core/classify.h"
#include "tests/bench/points/camera_points.h"

namespace nanomap::bench {
namespace {

/// Some deviation of a controller, not aligned with any axis.
UncertainPoint uncertain(const Vec3& p_B) {
  Mat3 covariance_m2;
  covariance_m2 << 0.010, 0.002, 0.000,  //
      0.002, 0.008, 0.001,               //
      0.000, 0.001, 0.004;
  return {p_B, covariance_m2};
}

bool isOutside(Status status) {
  return status == Status::kOutsideFov || status == Status::kBehind || status == Status::kBeyondRange;
}

}  // namespace

BodyPoints::BodyPoints(const ChainSnapshot& snapshot, std::span<const DepthImage> frames, Locate locate)
    : snapshot_(snapshot), frames_(frames), locate_(std::move(locate)) {
  assert(frames_.size() == snapshot_.views.size());
}

/// `draw(random)` makes a point or gives up on one try.
template <class Draw>
std::vector<UncertainPoint> BodyPoints::draw(unsigned seed, std::size_t count, Draw&& draw) const {
  constexpr std::size_t kTriesPerPoint = 200;
  std::mt19937 random(seed);
  std::vector<UncertainPoint> points_B;
  for (std::size_t tries = 0; points_B.size() < count; ++tries) {
    if (tries == count * kTriesPerPoint) return {};
    if (const std::optional<UncertainPoint> x_B = draw(random)) points_B.push_back(*x_B);
  }
  return points_B;
}

template <class Predicate>
bool BodyPoints::everyView(const UncertainPoint& x_B, Predicate&& holds) const {
  return std::ranges::all_of(snapshot_.views,
                             [&](const SnapshotView& view) { return holds(classify(view, x_B, QueryOptions{})); });
}

std::vector<UncertainPoint> BodyPoints::answeredBy(std::size_t first, std::size_t end, std::size_t count) const {
  constexpr unsigned kSeed = 7;
  if (first >= end || end > snapshot_.views.size()) return {};
  std::uniform_int_distribution<std::size_t> number(first, end - 1);
  return draw(kSeed, count, [&](std::mt19937& random) -> std::optional<UncertainPoint> {
    const std::size_t i = number(random);
    const SnapshotView& view = snapshot_.views[i];
    const Vec3f p_C = drawFreePoint(frames_[frames_.size() - 1 - i], view.view->camera(), random);
    const UncertainPoint x_B = uncertain(view.R_C_B.transpose() * (p_C.cast<double>() - view.t_C_B_m));
    const auto answering = locate_(x_B);
    if (!answering || *answering < first || *answering >= end) return std::nullopt;
    if (locate(snapshot_, x_B, {}).status == Status::kOpen) return std::nullopt;
    return x_B;
  });
}

std::vector<UncertainPoint> BodyPoints::inNoView(std::size_t count) const {
  constexpr unsigned kSeed = 8;
  constexpr double kReach_m = 20.0;
  std::uniform_real_distribution<double> coordinate_m(-kReach_m, kReach_m);
  return draw(kSeed, count, [&](std::mt19937& random) -> std::optional<UncertainPoint> {
    const double x_m = coordinate_m(random);
    const double y_m = coordinate_m(random);
    const UncertainPoint x_B = uncertain({x_m, y_m, coordinate_m(random)});
    if (!everyView(x_B, isOutside)) return std::nullopt;
    return x_B;
  });
}

std::vector<UncertainPoint> BodyPoints::occludedInEveryView(std::size_t count) const {
  constexpr unsigned kSeed = 9;
  const CameraModel& camera = snapshot_.views.front().view->camera();
  std::uniform_int_distribution<std::size_t> pixel(0, camera.pixelCount() - 1);
  std::uniform_real_distribution<double> depth_m(camera.frustum().near_m, camera.frustum().far_m);
  const SnapshotView& newest = snapshot_.views.front();
  return draw(kSeed, count, [&](std::mt19937& random) -> std::optional<UncertainPoint> {
    const Eigen::Vector2d tangents = camera.rayTangents(pixel(random)).cast<double>();
    const Vec3 p_C = depth_m(random) * Vec3(tangents.x(), tangents.y(), 1.0);
    const UncertainPoint x_B = uncertain(newest.R_C_B.transpose() * (p_C - newest.t_C_B_m));
    if (!everyView(x_B, [](Status status) { return status == Status::kOccluded; })) return std::nullopt;
    return x_B;
  });
}

}  // namespace nanomap::bench
