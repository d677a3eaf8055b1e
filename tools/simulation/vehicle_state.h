#pragma once

#include "core/geometry.h"

namespace nanomap::simulation {

/// True motion of the vehicle at one moment.
struct VehicleState {
  Pose T_W_B;
  Vec3 velocity_W_m_s = Vec3::Zero();
  Vec3 acceleration_W_m_s2 = Vec3::Zero();  ///< gravity removed
  Vec3 angular_rate_B_rad_s = Vec3::Zero();
};

}  // namespace nanomap::simulation
