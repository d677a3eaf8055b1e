#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/nearest_point_index.h"
#include "core/snapshot.h"
#include "core/status.h"

namespace nanomap {

/// What "in front of what was seen" is asked of.
enum class OcclusionTest : std::uint8_t {
  kMean,       ///< the mean's pixel, as in the paper (IV.A.2)
  kFootprint,  ///< also every return in the box's pixel footprint against the box's far face
};

struct QueryOptions {
  int k = 1;  ///< neighbours wanted, 1 .. kMaxNeighbours
  OcclusionTest occlusion = OcclusionTest::kMean;
  int open_window_px = 32;           ///< reach, to all sides, of the window that tells sky from a hole
  double open_range_fraction = 0.7;  ///< returns beyond this part of the range do not speak against sky
};

struct QueryReply {
  Status status = Status::kEmpty;
  std::optional<std::uint32_t> view_index;  ///< in the snapshot, 0 the newest; empty with kEmpty
  UncertainPoint x_C;                       ///< the point in that view's camera frame
  std::uint32_t neighbour_count = 0;
  std::array<Neighbour, kMaxNeighbours> neighbours;  ///< the first `neighbour_count`, by ascending distance

  [[nodiscard]] std::span<const Neighbour> found() const { return {neighbours.data(), neighbour_count}; }
};

/// What `view` knows about the point x_C in its camera frame: the 1-sigma box, half size sqrt(diag(Sigma)), against
/// the frustum's planes by exact support, and the occlusion test. `up_C` is the direction against gravity: it tells the
/// ground below a horizon from what surrounds a hole. Never kEmpty. NaN is never free.
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] Status classify(const View& view, const Vec3& mean_C_m, const Vec3& half_size_C_m, const Vec3& up_C,
                              const QueryOptions& options);

/// Nearest obstacles to an uncertain point, seen from the most recent view that contains it (Algorithm 1).
/// The search ends at the first kFree or kOpen; if there is none, the newest view answers with its own status.
/// @param x_B  in the body frame at the snapshot's stamp
/// @return     status, view, the point in that view's camera frame, up to k neighbours of the mean
/// @pre 1 <= options.k <= kMaxNeighbours
/// Allocates: no, except inside FLANN. Threads: any number of readers. "No view contains it" is a status, not an error.
[[nodiscard]] QueryReply query(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options);

/// The same for a batch: `replies[i]` answers `points_B[i]`. @pre equal sizes
void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                std::span<QueryReply> replies);

}  // namespace nanomap
