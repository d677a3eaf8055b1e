#pragma once

#include <cstdint>
#include <optional>

#include "planner/candidates.h"

namespace nanomap {

/// What to do where even stopping is above the chance constraint: drift has carried the vehicle too near to something,
/// a gust has, or what it stands beside was seen so long ago that nobody knows how near it is by now.
struct Retreat {
  std::uint32_t index = 0;  ///< of the candidate; isStop(): there is nothing better than stopping
  TrajectoryRisk brake;     ///< of its brake, which is all that would be flown; its veto is disregarded
};

/// The candidate whose brake is the least risk, of those whose brake
/// - begins at a slow pace, and
/// - is no more risk than stopping, neither on the way nor at its end, and
/// - ends where standing is half that risk or less, or leads away from everything measured: at no sample nearer to it
///   than the vehicle is, at the end farther by the objective's least gain, and
/// - is known: leads through nothing whose prior alone is above the constraint, and ends in space seen as free or in
///   the bubble. What no view has room around is a risk like others here: no stop is refused for it.
/// What is compared is risk, because distances to one thing in two views differ by the drift between them, and the risk
/// knows how far each is to be trusted. One that ends in space seen as free goes before one that does not: a step back
/// into what was not seen is the last resort, and no longer than it takes until standing still is within the constraint
/// again. Where a collision on the way is as good as certain, the end decides, by its risk and then its distance; of
/// equal ones the lowest index. If there is none, stopping, if that is known. Empty if it is not. Stopping is at once,
/// or as what is in force does, whichever is the better by that order.
/// @param parameters  that the candidates were made with
/// Allocates: no, except inside FLANN. Threads: any number of callers.
[[nodiscard]] std::optional<Retreat> chooseRetreat(const Candidates& candidates, const PlannerParameters& parameters);

}  // namespace nanomap
