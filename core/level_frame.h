#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry.h"

namespace nanomap {

/// Heading [rad] of the body's forward axis in W, from x towards y; 0 if it points straight up or down.
[[nodiscard]] inline double yawOf(const Quat& R_W_B) {
  const Vec3 forward_W = R_W_B * Vec3::UnitX();
  return std::atan2(forward_W.y(), forward_W.x());
}

/// R_W_L: L has the yaw of B, and its z axis is W's, however far the body is pitched or rolled.
[[nodiscard]] inline Mat3 levelAxes(double yaw_W_rad) {
  return Eigen::AngleAxisd(yaw_W_rad, Vec3::UnitZ()).toRotationMatrix();
}

/// The same angle within -pi .. pi.
[[nodiscard]] inline double wrapAngle(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

}  // namespace nanomap
