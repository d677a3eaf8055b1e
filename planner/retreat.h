#pragma once

#include <cstdint>
#include <optional>

#include "planner/candidates.h"

namespace nanomap {

/// A way out of a place where even standing still is above the chance constraint: drift has carried the vehicle too
/// near to something, or a gust has. Holding on there makes nothing safer.
struct Retreat {
  std::uint32_t index = 0;
  TrajectoryRisk brake;  ///< of the candidate's brake, which is all that would be flown; its veto is disregarded
};

/// The candidate whose brake ends farthest from everything measured, of those whose brake
/// - at no sample comes nearer to a measured point than the vehicle is already, and
/// - leads through nothing whose prior alone is above the constraint, and
/// - ends in space seen as free or within the bubble, and there has gained `least_gain_m` of clearance.
/// One that ends in space seen as free goes before one that does not: a step back into what was not seen is the last
/// resort, and no longer than it takes until standing still is within the constraint again. Of equal ones the lowest
/// index. Empty if there is none: nothing is better than where the vehicle is.
/// Allocates: no, except inside FLANN. Threads: any number of callers.
[[nodiscard]] std::optional<Retreat> chooseRetreat(const Candidates& candidates, double least_gain_m, double max_prior);

}  // namespace nanomap
