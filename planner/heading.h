#pragma once

#include "core/geometry.h"
#include "core/time.h"
#include "core/view.h"

namespace nanomap {

struct HeadingParameters {
  double max_rate_rad_s = 1.0;
  double reach_s = 0.5;               ///< the heading handed out can be reached in this time
  double min_speed_m_s = 0.3;         ///< slower than that, a velocity has no direction worth looking in
  double sweep_amplitude_rad = 1.05;  ///< to each side of the goal
  double sweep_rate_rad_s = 0.6;
};

/// A heading to be turned to, and how fast.
struct HeadingCommand {
  double yaw_W_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// The part of the way from `yaw_W_rad` to `wanted_W_rad`, the shorter way round, that the rate allows.
[[nodiscard]] HeadingCommand turn(double yaw_W_rad, double wanted_W_rad, const HeadingParameters& parameters);

/// Offset [rad] from the middle of a search to both sides: a triangle wave over time, so that a vehicle that finds
/// itself blocked again goes on searching where it was. Between plus and minus the sweep's amplitude.
[[nodiscard]] double sweepOffset(Time time, const HeadingParameters& parameters);

/// How a camera looks from a level body: where, and how far to each side.
struct HorizontalView {
  double yaw_B_rad = 0.0;
  double half_width_rad = 0.0;  ///< of the narrower side
};
[[nodiscard]] HorizontalView horizontalView(const CameraModel& camera);

}  // namespace nanomap
