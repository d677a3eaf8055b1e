#pragma once

#include <cstddef>
#include <span>

#include "core/view_lanes.h"

namespace nanomap {

/// Goes on block by block, from where `out` is, to the next with a view that may answer kFree or kOpen, so that the
/// views passed over certainly do not: the mean is outside the frustum, the box is not contained, or its pixel carries
/// a depth and it is not nearer than anything in its tile, or in its column there. Vector code, chosen at run time.
/// @param groups  of sixteen `blocks` each, the last of as many as are left
/// @return  is there one? Then `out` is about it.
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] bool scanViews(std::span<const BlockLanes> groups, std::span<const ViewLanes> blocks,
                             const PointProbe& probe, ProbedLanes& out);

}  // namespace nanomap
