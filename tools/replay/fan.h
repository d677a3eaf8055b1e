#pragma once

#include <vector>

#include "core/geometry.h"
#include "tools/replay/deviation.h"

namespace nanomap {

/// The motions that a replay asks about at every frame.
struct FanParameters {
  int headings = 9;              ///< over -max_heading .. max_heading, ends included
  double max_heading_rad = 1.2;  ///< direction from the start to the end of the outermost motions: about 70 degrees
  int climbs = 3;                ///< over -max_climb .. max_climb, ends included
  double max_climb_rad = 0.35;   ///< about 20 degrees
  int samples = 10;              ///< points along each motion, evenly spaced; the last at the range
  DeviationModel deviation;
};

/// Points in B along a fan of motions. Each motion leaves along the vehicle's own heading and turns at a constant rate,
/// so that after `range_m` its end lies in direction `heading` (positive to the left), while climbing at the angle
/// `climb`: an arc on a cone. Motions are defined in L, the level frame (the body's origin and yaw, z up), so that a
/// pitched vehicle still asks about the space ahead of it.
/// Ordered by climb (lowest first), then heading (rightmost first), then distance.
/// @param R_W_B  the vehicle's orientation
[[nodiscard]] std::vector<UncertainPoint> fanPoints(const FanParameters& parameters, const Quat& R_W_B, double range_m);

}  // namespace nanomap
