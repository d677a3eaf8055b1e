#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/geometry.h"

namespace nanomap {

/// Most neighbours a query can ask for.
inline constexpr int kMaxNeighbours = 16;

/// Which implementation indexes the frames. Both give the same distances.
enum class IndexKind : std::uint8_t {
  kImage,  ///< ours, over the image's tiles (core/image_index.h)
  kFlann,  ///< FLANN's k-d tree, the reference (core/flann_index.h)
};

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

  static constexpr float kAnyDistance = std::numeric_limits<float>::infinity();

  /// Fills `out` with the nearest points to `p_C` by ascending distance; asks for `out.size()` of them,
  /// 1 .. kMaxNeighbours, no farther than `max_distance_m`. Distances are float arithmetic over (x, y, z) in that
  /// order.
  /// @return how many were found: the smaller of `out.size()` and the number of points within `max_distance_m`. None
  ///         are within a negative distance or NaN, nor near a `p_C` that is not finite, nor so far away that the
  ///         square of the distance is no finite float.
  [[nodiscard]] virtual std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out,
                                            float max_distance_m = kAnyDistance) const = 0;

  /// Number of points indexed: the returns in the camera's trusted range. May count them.
  [[nodiscard]] virtual std::size_t size() const = 0;
};

}  // namespace nanomap
