#pragma once

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// The attitude R_A_B after `duration` at the given rate, about axes of B; a negative duration leads back.
[[nodiscard]] inline Quat turned(const Quat& R_A_B, const Vec3& angular_rate_B_rad_s, Duration duration) {
  const double angle_rad = angular_rate_B_rad_s.norm() * toSeconds(duration);
  if (angle_rad == 0.0) return R_A_B;
  return R_A_B * Quat(Eigen::AngleAxisd(angle_rad, angular_rate_B_rad_s.normalized()));
}

}  // namespace nanomap
