#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/certified_clearance.h"
#include "core/classify.h"
#include "core/nearest_point_index.h"
#include "core/query_options.h"
#include "core/snapshot.h"
#include "core/status.h"

namespace nanomap {

/// Which view answers for a point.
struct Location {
  Status status = Status::kEmpty;
  std::optional<std::uint32_t> view_index;  ///< in the snapshot, 0 the newest; empty with kEmpty

  bool operator==(const Location&) const = default;
};

struct QueryReply {
  Status status = Status::kEmpty;
  std::optional<std::uint32_t> view_index;  ///< in the snapshot, 0 the newest; empty with kEmpty
  UncertainPoint x_C;                       ///< the point in that view's camera frame
  /// With QueryOptions::certify: space is known to be empty this far around the point's mean, and no farther than the
  /// nearest neighbour. A nearest neighbour alone knows nothing of what lies outside its view, or hidden in it.
  std::optional<CertifiedClearance> certified;
  std::uint32_t neighbour_count = 0;
  /// The first `neighbour_count`, by ascending distance. Last, for what lies behind those is not touched by a batch:
  /// with few neighbours that is most of a reply.
  std::array<Neighbour, kMaxNeighbours> neighbours;

  [[nodiscard]] std::span<const Neighbour> found() const { return {neighbours.data(), neighbour_count}; }
};

/// The first half of a query: the most recent view that contains the uncertain point (Algorithm 1). The search ends at
/// the first kFree or kOpen; if there is none, the newest view answers with its own status.
/// @param x_B  in the body frame at the snapshot's stamp
/// Equals a classify() of every view in turn, and skips those that the snapshot's filter rules out.
/// Allocates: no. Threads: any number of readers. "No view contains it" is a status, not an error.
[[nodiscard]] Location locate(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options);

/// The newest of the first `count` views whose frustum holds the mean, whatever else it knows of it; empty: none does.
/// @param mean_B_m  as locate()'s. @pre no more than the snapshot has
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] std::optional<std::uint32_t> newestHolding(const ChainSnapshot& snapshot, const Vec3& mean_B_m,
                                                         std::uint32_t count);

/// Nearest obstacles to an uncertain point, in the view that locate() finds.
/// @return     status, view, the point in that view's camera frame, up to k neighbours of the mean
/// @pre 1 <= options.k <= kMaxNeighbours
/// Allocates: no, except inside FLANN. Threads: any number of readers.
[[nodiscard]] QueryReply query(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options);

/// The second half, for a point that locate() has placed: its mean and covariance in the view's frame and its nearest
/// neighbours, no farther than `max_distance_m`; nor is a certified radius of interest that is larger.
/// @pre as of query(), and `location` is locate()'s for the same arguments
/// Allocates: no, except inside FLANN. Threads: any number of readers.
[[nodiscard]] QueryReply nearestAt(const ChainSnapshot& snapshot, const Location& location, const UncertainPoint& x_B,
                                   const QueryOptions& options, float max_distance_m = NearestPointIndex::kAnyDistance);

/// What queryBatch() works in. Keep one for each thread: it allocates only for more points or views than ever before.
class QueryScratch {
 public:
  /// Points in the order of their views, the newest first.
  [[nodiscard]] std::span<const std::uint32_t> orderByView(std::span<const Location> locations, std::size_t view_count);

  [[nodiscard]] std::span<Location> locations(std::size_t count);

 private:
  std::vector<Location> locations_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> first_of_view_;
};

/// Queries a batch, a primitive's samples or a whole plan's: `replies[i]` answers `points_B[i]` as query() does. All
/// points are placed first and then searched for view by view, so that each view's index is fetched once. Of `replies`,
/// neighbours behind those that are found are not specified.
/// @param max_distances_m  of each point's neighbours; empty: as far as there are any
/// @pre as many replies as points, and as many distances unless there are none
/// A caller that may stop early places its points with locate(), and asks nearestAt() for those that still matter.
void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                QueryScratch& scratch, std::span<QueryReply> replies, std::span<const float> max_distances_m = {});

/// The same with a scratch of its own, which it allocates: for tools.
void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                std::span<QueryReply> replies);

}  // namespace nanomap
