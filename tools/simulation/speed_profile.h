#pragma once

#include <vector>

namespace nanomap::simulation {

/// What a vehicle that tilts can do.
struct SpeedLimits {
  double max_acceleration_m_s2 = 0.0;  ///< along and across the path together
  double max_speed_up_m_s2 = 0.0;      ///< along the path, when gaining speed
  double max_yaw_rate_rad_s = 0.0;     ///< speed times curvature
};

/// Highest speed at each of a path's equidistant points, from rest to rest, that respects the limits.
/// @param step_m            between neighbouring points
/// @param curvature_per_m   of the path at each point
/// @param wanted_m_s        not exceeded at each point
[[nodiscard]] std::vector<double> speedProfile(double step_m, const std::vector<double>& curvature_per_m,
                                               std::vector<double> wanted_m_s, const SpeedLimits& limits);

}  // namespace nanomap::simulation
