#pragma once

#include <cstdint>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// How the vehicle moves, as the estimator last said. Velocity and acceleration are those of B's origin in W; the
/// acceleration is that of the motion, without gravity.
struct VehicleState {
  Time stamp{};
  std::uint32_t epoch = 0;     ///< of the world that everything here is given in
  std::uint64_t sequence = 0;  ///< the estimator's own count
  Pose T_W_B;
  Vec3 velocity_W_m_s = Vec3::Zero();
  Vec3 acceleration_W_m_s2 = Vec3::Zero();
};

}  // namespace nanomap
