#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

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
  std::uint32_t neighbour_count = 0;
  std::array<Neighbour, kMaxNeighbours> neighbours;  ///< the first `neighbour_count`, by ascending distance

  [[nodiscard]] std::span<const Neighbour> found() const { return {neighbours.data(), neighbour_count}; }
};

/// The first half of a query: the most recent view that contains the uncertain point (Algorithm 1). The search ends at
/// the first kFree or kOpen; if there is none, the newest view answers with its own status.
/// @param x_B  in the body frame at the snapshot's stamp
/// Equals a classify() of every view in turn, and skips those that the snapshot's filter rules out.
/// Allocates: no. Threads: any number of readers. "No view contains it" is a status, not an error.
[[nodiscard]] Location locate(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options);

/// Nearest obstacles to an uncertain point, in the view that locate() finds.
/// @return     status, view, the point in that view's camera frame, up to k neighbours of the mean
/// @pre 1 <= options.k <= kMaxNeighbours
/// Allocates: no, except inside FLANN. Threads: any number of readers.
[[nodiscard]] QueryReply query(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options);

/// The same for a batch: `replies[i]` answers `points_B[i]`. @pre equal sizes
void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                std::span<QueryReply> replies);

}  // namespace nanomap
