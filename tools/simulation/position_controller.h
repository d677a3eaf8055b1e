#pragma once

#include "core/time.h"
#include "core/trajectory.h"
#include "tools/simulation/multicopter.h"

namespace nanomap::simulation {

/// Gains of the cascade from position to acceleration; the defaults are PX4's (MPC_XY_P, MPC_Z_P, MPC_*_VEL_*_ACC).
struct PositionControllerParameters {
  Vec3 position_1_s = Vec3(0.95, 0.95, 1.0);
  Vec3 velocity_1_s = Vec3(1.8, 1.8, 4.0);
  Vec3 integral_1_s2 = Vec3(0.4, 0.4, 2.0);
  double max_integral_m_s2 = 4.0;
};

/// Follows setpoints of position, velocity and acceleration by what an estimator says of the first two, as PX4's
/// multicopter position control does. Threads: one.
class PositionController {
 public:
  explicit PositionController(const PositionControllerParameters& parameters) : parameters_(parameters) {}

  /// @param setpoint, estimated  in one world; of the latter position and velocity are used
  /// @param since  time since the last call
  [[nodiscard]] Vec3 acceleration(const Motion& setpoint, const Motion& estimated, Duration since);

 private:
  PositionControllerParameters parameters_;
  Vec3 integral_m_s2_ = Vec3::Zero();
};

}  // namespace nanomap::simulation
