#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/snapshot_view.h"
#include "core/view_lanes.h"

namespace nanomap {

/// Rules out views of a snapshot, many at a time and in single precision, that certainly do not answer a point with
/// kFree or kOpen. What it leaves is decided by classify(), so that no answer depends on the filter's rounding, on the
/// vector unit, or on there being a filter at all.
///
/// Why it is certain. With u = 2^-24, m = |mean_B| + max |t_C_B|, T the largest tangent of a side plane and h the
/// largest half size of a box with its margin, all of them rounded once themselves: a coordinate is off by at most
/// 8 u m, a distance from a side plane (times the length of its normal) by 11 u m (1 + T), a half size's share of it by
/// 5 u h (1 + T), the distance that makes a cell by 27 u m (1 + T), the bound on a block's side planes by
/// 23 u m (1 + T), and of its near and far planes, where it matters, by 40 u m; slack_m = 64 u (m + h) (1 + T) is above
/// the sum of any of these that meet. A variance is off by at most 14 u times the sum of the variances that make it;
/// slack_m2 is 32 u times that.
///
/// Threads: any number of readers. Allocates only when it holds more views than ever before.
class ViewFilter {
 public:
  /// Views beyond all reason (no rotation, not finite, or 1000 km away) make an empty filter. Borrows what
  /// `views` point to.
  void assign(std::span<const SnapshotView> views);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }

  /// The views that may answer `x_B`, in order. Borrows the filter, which borrows the views.
  class Walk {
   public:
    /// @param view_count  as many as the filter was assigned; if it is empty, all of them are walked
    /// @param options     what is asked; borrowed
    /// @param first       the first view of interest
    Walk(const ViewFilter& filter, std::size_t view_count, const UncertainPoint& x_B, const QueryOptions& options,
         std::uint32_t first);

    /// The next view; empty behind the last.
    [[nodiscard]] std::optional<std::uint32_t> next();

    /// Is the mean certainly before a hole, in the view that next() gave last?
    [[nodiscard]] bool isBeforeHole() const;

   private:
    [[nodiscard]] bool isOccluded(const ViewLanes& lanes, std::uint32_t lane) const;

    std::span<const BlockLanes> groups_;
    std::span<const ViewLanes> blocks_;  ///< none: nothing is ruled out
    const QueryOptions& options_;
    std::uint32_t view_count_;
    std::uint32_t first_;     ///< views before it are of no interest
    std::uint32_t lane_ = 0;  ///< of the view that next() gave last, in the block of `probed_`
    PointProbe probe_;
    ProbedLanes probed_;
  };

 private:
  std::vector<BlockLanes> groups_;  ///< of blocks
  std::vector<ViewLanes> blocks_;   ///< of views
  double reach_m_ = 0.0;            ///< largest |t_C_B|
  double largest_tangent_ = 0.0;    ///< of a side plane
  double largest_edge_variance_m2_ = 0.0;
};

}  // namespace nanomap
