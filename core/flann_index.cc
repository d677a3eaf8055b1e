#include "core/flann_index.h"

#include <array>
#include <cassert>
#include <cmath>
#include <flann/flann.hpp>
#include <optional>
#include <vector>

namespace nanomap {
namespace {

using Tree = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;

class FlannIndex final : public NearestPointIndex {
 public:
  explicit FlannIndex(std::vector<Vec3f> points_C) : points_C_(std::move(points_C)) {
    if (points_C_.empty()) return;  // FLANN has no empty tree
    constexpr int kLeafSize = 15;
    constexpr bool kReorder = true;
    tree_.emplace(flann::Matrix<float>(points_C_.front().data(), points_C_.size(), 3),
                  flann::KDTreeSingleIndexParams(kLeafSize, kReorder));
    tree_->buildIndex();
  }

  [[nodiscard]] std::size_t size() const override { return points_C_.size(); }

  [[nodiscard]] std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out, float max_distance_m) const override {
    assert(!out.empty() && out.size() <= kMaxNeighbours);
    const bool anything_within = max_distance_m >= 0.0F;
    if (!tree_ || !anything_within || !p_C.allFinite()) return 0;
    flann::KNNSimpleResultSet<float> found(out.size());
    tree_->findNeighbors(found, p_C.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, 0.0F));
    std::array<std::size_t, kMaxNeighbours> ids;
    std::array<float, kMaxNeighbours> distances_sq_m2;
    const std::size_t count = std::min(found.size(), out.size());
    found.copy(ids.data(), distances_sq_m2.data(), count);
    std::size_t within = 0;
    for (; within < count; ++within) {
      const float distance_m = std::sqrt(distances_sq_m2[within]);
      if (distance_m > max_distance_m) break;
      out[within] = {points_C_[ids[within]], distance_m};
    }
    return within;
  }

 private:
  static_assert(sizeof(Vec3f) == 3 * sizeof(float), "FLANN reads the points as rows of three floats");

  std::vector<Vec3f> points_C_;
  std::optional<Tree> tree_;
};

}  // namespace

std::unique_ptr<NearestPointIndex> buildFlannIndex(const DepthImage& image, const CameraModel& camera) {
  std::vector<Vec3f> points_C;
  points_C.reserve(image.pixels.size());
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
    const std::uint16_t raw = image.pixels[pixel];
    if (camera.classify(raw) == DepthReading::kInRange) points_C.push_back(camera.deproject(pixel, raw));
  }
  return std::make_unique<FlannIndex>(std::move(points_C));
}

}  // namespace nanomap
