#pragma once

#include <cstddef>
#include <span>

#include "core/geometry.h"

namespace nanomap {

/// Most neighbours a query can ask for.
inline constexpr int kMaxNeighbours = 16;

/// One measured point, in the camera frame of its view.
struct Neighbour {
  Vec3f point_C = Vec3f::Zero();
  float distance_m = 0.0F;
};

/// Exact k nearest measured points of one view. Immutable once built.
/// Threads: any number of readers.
class NearestPointIndex {
 public:
  NearestPointIndex() = default;
  NearestPointIndex(const NearestPointIndex&) = delete;
  NearestPointIndex& operator=(const NearestPointIndex&) = delete;
  virtual ~NearestPointIndex() = default;

  /// Fills `out` with the nearest points to `p_C` by ascending distance; asks for `out.size()` of them,
  /// 1 .. kMaxNeighbours. Distances are float arithmetic over (x, y, z) in that order.
  /// @return how many were found: the smaller of `out.size()` and `size()`
  [[nodiscard]] virtual std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out) const = 0;

  /// Number of points indexed: the returns in the camera's trusted range.
  [[nodiscard]] virtual std::size_t size() const = 0;
};

}  // namespace nanomap
