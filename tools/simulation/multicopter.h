#pragma once

#include "core/geometry.h"
#include "core/time.h"
#include "tools/simulation/vehicle_state.h"

namespace nanomap::simulation {

/// What a multicopter of some two kilograms does with what it is told.
struct MulticopterParameters {
  double radius_m = 0.4;                   ///< of the sphere that holds it
  double attitude_time_constant_s = 0.08;  ///< first-order lag of the thrust's direction
  double thrust_time_constant_s = 0.04;    ///< first-order lag of its amount
  double yaw_time_constant_s = 0.25;
  double max_tilt_rad = 0.785;  ///< 45 degrees, PX4's MPC_TILTMAX_AIR
  double max_yaw_rate_rad_s = 1.5;
  double min_thrust_m_s2 = 1.0;  ///< of thrust per mass; the propellers never stop
  double max_thrust_m_s2 = 20.0;
  double drag_1_s = 0.1;  ///< deceleration per speed
};

/// Acceleration, gravity removed, and heading that the vehicle is to take.
struct MulticopterCommand {
  Vec3 acceleration_W_m_s2 = Vec3::Zero();
  double yaw_W_rad = 0.0;
};

/// True motion of a vehicle with limited tilt and thrust, first-order lags and linear drag. Threads: one.
class Multicopter {
 public:
  /// At rest, level. @throws std::invalid_argument naming the parameter and its value
  Multicopter(const MulticopterParameters& parameters, const Vec3& position_W_m, double yaw_W_rad);

  /// Obeys `command` for `duration`.
  void advance(const MulticopterCommand& command, Duration duration);

  [[nodiscard]] VehicleState state() const;

 private:
  void step(const MulticopterCommand& command, double step_s);

  MulticopterParameters parameters_;
  Vec3 position_W_m_;
  Vec3 velocity_W_m_s_ = Vec3::Zero();
  Vec3 acceleration_W_m_s2_ = Vec3::Zero();
  Vec3 thrust_direction_W_ = Vec3::UnitZ();
  double thrust_m_s2_;
  double yaw_W_rad_;
  Vec3 angular_rate_B_rad_s_ = Vec3::Zero();
};

}  // namespace nanomap::simulation
