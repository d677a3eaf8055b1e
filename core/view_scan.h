#pragma once

#include <cstddef>
#include <span>

#include "core/view_lanes.h"

namespace nanomap {

/// Probes `lanes` block by block and stops at the first with a view that may answer kFree or kOpen, so that the views
/// passed over certainly do not: the mean is outside the frustum, the box is not contained, or its pixel carries a
/// depth and it is not nearer than anything in its tile, or in its column there. Vector code, chosen at run time.
/// @return  that block's index, with `out` filled; lanes.size() if there is none
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] std::size_t scanViews(std::span<const ViewLanes> lanes, const PointProbe& probe, ProbedLanes& out);

}  // namespace nanomap
