#include "tools/simulation/attitude.h"

#include <cmath>

namespace nanomap::simulation {

Quat attitudeFor(const Vec3& acceleration_W_m_s2, double yaw_W_rad) {
  const Vec3 across_W(-std::sin(yaw_W_rad), std::cos(yaw_W_rad), 0.0);
  const Vec3 z_W = (acceleration_W_m_s2 + kGravity_m_s2 * Vec3::UnitZ()).normalized();
  const Vec3 x_W = across_W.cross(z_W).normalized();
  Mat3 R_W_B;
  R_W_B << x_W, z_W.cross(x_W), z_W;
  return Quat(R_W_B);
}

}  // namespace nanomap::simulation
