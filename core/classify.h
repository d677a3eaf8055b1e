#pragma once

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/snapshot_view.h"
#include "core/status.h"
#include "core/view.h"

namespace nanomap {

/// What `view` knows about the point x_C in its camera frame: the 1-sigma box, half size sqrt(diag(Sigma)), against
/// the frustum's planes by exact support, and the occlusion test. `up_C` is the direction against gravity: it tells the
/// ground below a horizon from what surrounds a hole. Never kEmpty. NaN is never free.
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] Status classify(const View& view, const Vec3& mean_C_m, const Vec3& half_size_C_m, const Vec3& up_C,
                              const QueryOptions& options);

/// Is the box mean +- half_size inside the frustum? Each plane is tested against the box's support in its direction.
[[nodiscard]] bool contains(const Frustum& frustum, const Vec3& mean_C_m, const Vec3& half_size_C_m);

/// classify() for x_B, in the frame of the snapshot that the view is part of.
[[nodiscard]] Status classify(const SnapshotView& candidate, const UncertainPoint& x_B, const QueryOptions& options);

/// Does the backward search end at a view with this status?
[[nodiscard]] constexpr bool endsSearch(Status status) { return status == Status::kFree || status == Status::kOpen; }

}  // namespace nanomap
