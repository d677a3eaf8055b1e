#pragma once

#include <optional>

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/view.h"

namespace nanomap {

/// Which radii are of interest [m].
struct RadiiOfInterest {
  double above_m = 0.0;  ///< one that is not above this is as good as none
  double limit_m = 0.0;  ///< by how much one is above this is of no interest
};

/// A ball in which a view has seen all space to be empty.
struct VouchedBall {
  double radius_m = 0.0;                 ///< 0: the view vouches for nothing of interest
  std::optional<Vec3> nearest_unseen_C;  ///< what keeps it from being larger, unless planes or the limit do
};

/// The largest ball around `p_C` that `view` vouches for: inside the frustum, between the range limits, and in front of
/// what each ray met. Its radius is the least of the distances from the planes and from the unseen part of any ray less
/// a pixel: an edge may lie anywhere between two rays. The unseen part begins at the return; on a ray without one, if
/// it is
/// - under open sky (core/open_sky.h, asked for all of a tile of core/depth_tiles.h): nowhere;
/// - in a gap of at most `options.narrow_gap_px` pixels along its row or column: at the nearest of the gap's ends, as
///   what hides in it is that narrow, and nearer;
/// - elsewhere: at the near limit.
/// So the radius is never above the distance of the view's nearest return. What is thinner than a pixel may be missed.
/// @param up_C          the direction against gravity
/// @param look_first_C  where something unseen may be near: saves time if so
/// Allocates: no. Threads: any number of readers. A point that is not finite: 0.
[[nodiscard]] VouchedBall vouchedBall(const View& view, const Vec3& p_C, const Vec3& up_C, const QueryOptions& options,
                                      const RadiiOfInterest& of_interest,
                                      const std::optional<Vec3>& look_first_C = std::nullopt);

}  // namespace nanomap
