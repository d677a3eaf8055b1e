#include "tests/bench/references/nanoflann_index.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "core/search_radius.h"
#include "tests/bench/references/point_cloud.h"

namespace nanomap::bench {
namespace {

/// Points as nanoflann reads them.
struct Cloud {
  std::vector<Vec3f> points_C;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points_C.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t point, std::size_t axis) const { return points_C[point].data()[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // let nanoflann compute it
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;

class NanoflannIndex final : public NearestPointIndex {
 public:
  NanoflannIndex(std::vector<Vec3f> points_C, int leaf)
      : cloud_{std::move(points_C)},
        tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(static_cast<std::size_t>(leaf))) {
    tree_.buildIndex();
  }

  [[nodiscard]] std::size_t size() const override { return cloud_.points_C.size(); }

  [[nodiscard]] std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out, float max_distance_m) const override {
    assert(!out.empty() && out.size() <= kMaxNeighbours);
    const auto limit_sq_m2 = greatestSquareWithin(max_distance_m);
    if (!limit_sq_m2 || cloud_.points_C.empty() || !p_C.allFinite()) return 0;
    std::array<std::uint32_t, kMaxNeighbours> ids;
    std::array<float, kMaxNeighbours> distances_sq_m2;
    nanoflann::KNNResultSet<float, std::uint32_t> found(out.size());
    found.init(ids.data(), distances_sq_m2.data());
    // Only what is nearer than the result set's last distance enters it.
    distances_sq_m2[out.size() - 1] = std::nextafter(*limit_sq_m2, kAnyDistance);
    tree_.findNeighbors(found, p_C.data(), nanoflann::SearchParams());
    for (std::size_t i = 0; i < found.size(); ++i) {
      out[i] = {cloud_.points_C[ids[i]], std::sqrt(distances_sq_m2[i])};
    }
    return found.size();
  }

 private:
  Cloud cloud_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<const NearestPointIndex> buildNanoflannIndex(const DepthImage& image, const CameraModel& camera,
                                                             int leaf) {
  return std::make_unique<NanoflannIndex>(pointCloud(image, camera), leaf);
}

}  // namespace nanomap::bench
