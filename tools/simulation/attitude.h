#pragma once

#include "core/geometry.h"

namespace nanomap::simulation {

inline constexpr double kGravity_m_s2 = 9.80665;

/// Attitude of a vehicle whose thrust, along its z, gives the acceleration (gravity removed), and whose x points along
/// the yaw as seen from above. @pre it does not fall freely
[[nodiscard]] Quat attitudeFor(const Vec3& acceleration_W_m_s2, double yaw_W_rad);

}  // namespace nanomap::simulation
