#include "tests/bench/references/sequential_chain.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace nanomap::bench {
namespace {

bool boxIsInside(const Frustum& frustum, const Vec3& mean_C_m, const Mat3& covariance_C_m2) {
  const Vec3 half_m = covariance_C_m2.diagonal().cwiseMax(0.0).cwiseSqrt();
  const auto insideSide = [&](int axis, double tangent, double sign) {
    return sign * (mean_C_m[axis] - tangent * mean_C_m.z()) >= half_m[axis] + std::abs(tangent) * half_m.z();
  };
  return mean_C_m.z() - half_m.z() >= frustum.near_m && mean_C_m.z() + half_m.z() <= frustum.far_m &&
         insideSide(0, frustum.tan_left, 1.0) && insideSide(0, frustum.tan_right, -1.0) &&
         insideSide(1, frustum.tan_top, 1.0) && insideSide(1, frustum.tan_bottom, -1.0);
}

bool isInFrontOfSurface(const IndexedFrame& frame, const Vec3& mean_C_m) {
  const auto pixel = frame.camera->pixelAt(mean_C_m.x() / mean_C_m.z(), mean_C_m.y() / mean_C_m.z());
  if (!pixel) return false;
  const auto at = static_cast<std::size_t>(pixel->v) * static_cast<std::size_t>(frame.image->width_px) +
                  static_cast<std::size_t>(pixel->u);
  const std::uint16_t raw = frame.image->pixels[at];
  return frame.camera->classify(raw) != DepthReading::kNone &&
         mean_C_m.z() < static_cast<double>(frame.camera->depth(raw));
}

bool contains(const IndexedFrame& frame, const Vec3& mean_C_m, const Mat3& covariance_C_m2) {
  return boxIsInside(frame.camera->frustum(), mean_C_m, covariance_C_m2) && mean_C_m.z() > 0.0 &&
         isInFrontOfSurface(frame, mean_C_m);
}

}  // namespace

SequentialChain::SequentialChain(std::span<const Edge> edges, std::vector<IndexedFrame> frames) {
  assert(!frames.empty() && edges.size() == frames.size());
  links_.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    links_.push_back({edges[i].T_older_newer.rotation.toRotationMatrix(), edges[i].T_older_newer.translation_m,
                      edges[i].covariance_older_m2, std::move(frames[i])});
  }
}

SequentialChain::Walk SequentialChain::walk(const UncertainPoint& x_B) const {
  Vec3 mean_m = x_B.mean_m;
  Mat3 covariance_m2 = x_B.covariance_m2;
  Vec3 mean_newest_m = Vec3::Zero();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    mean_m = link.R_older_newer * mean_m + link.t_older_newer_m;
    covariance_m2 = link.covariance_older_m2 + link.R_older_newer * covariance_m2 * link.R_older_newer.transpose();
    if (i == 0) mean_newest_m = mean_m;
    if (contains(link.frame, mean_m, covariance_m2)) return {static_cast<std::uint32_t>(i), mean_m};
  }
  return {std::nullopt, mean_newest_m};
}

std::optional<std::uint32_t> SequentialChain::locate(const UncertainPoint& x_B) const { return walk(x_B).view; }

SequentialChain::Answer SequentialChain::query(const UncertainPoint& x_B, int k) const {
  Answer answer;
  const Walk found = walk(x_B);
  answer.view = found.view;
  answer.neighbour_count = links_[found.view.value_or(0)].frame.index->nearest(
      found.mean_C_m.cast<float>(), std::span(answer.neighbours).first(static_cast<std::size_t>(k)));
  return answer;
}

}  // namespace nanomap::bench
