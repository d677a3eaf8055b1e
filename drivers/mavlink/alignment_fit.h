#pragma once

#include "core/geometry.h"
#include "core/ring_buffer.h"
#include "core/time.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

/// The vehicle at one moment, as the VIO and the autopilot have it.
struct AlignmentPair {
  Time stamp{};
  Vec3 position_W_m = Vec3::Zero();
  double yaw_W_rad = 0.0;
  Vec3 position_NED_m = Vec3::Zero();
  double heading_NED_rad = 0.0;
};

/// What the two sources of the heading are trusted to. Neither averages out: a compass and a slow drift of the position
/// are wrong in the same way for all of the window.
struct AlignmentWeights {
  double attitude_sigma_rad = 0.05;
  double position_sigma_m = 0.3;
};

/// The T_NED_W that explains the pairs best. Robust: outliers among them have little weight.
/// The attitudes tell the heading; so does the shape of the tracks, with a precision that grows with their extent.
/// @pre at least one pair
[[nodiscard]] NedFromWorld fitAlignment(const RingBuffer<AlignmentPair>& pairs, const AlignmentWeights& weights);

/// T_NED_W of that heading, placed as the pairs of the newest `window` say in the median: where a world that drifts is
/// now, and not where it was half a window ago. @pre at least one pair
[[nodiscard]] NedFromWorld placedByNewest(const RingBuffer<AlignmentPair>& pairs, double heading_rad, Duration window);

struct AlignmentResiduals {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

/// How far one pair is off.
[[nodiscard]] AlignmentResiduals residualsOf(const AlignmentPair& pair, const NedFromWorld& T_NED_W);

/// The medians over the pairs. @pre at least one pair
[[nodiscard]] AlignmentResiduals medianResiduals(const RingBuffer<AlignmentPair>& pairs, const NedFromWorld& T_NED_W);

}  // namespace nanomap
