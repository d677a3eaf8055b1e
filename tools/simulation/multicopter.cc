#include "tools/simulation/multicopter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/level_frame.h"
#include "tools/simulation/attitude.h"

namespace nanomap::simulation {
namespace {

constexpr double kStep_s = 0.002;

void requirePositive(double value, const char* name) {
  if (value > 0.0) return;
  throw std::invalid_argument(std::string("multicopter: ") + name + " is " + std::to_string(value) +
                              ", must be positive");
}

/// Thrust per mass that would give the acceleration, within the limits of tilt and amount. Height comes first: what
/// the amount does not allow is taken from the horizontal part.
Vec3 allowedThrust(const Vec3& acceleration_W_m_s2, const MulticopterParameters& parameters) {
  Vec3 thrust_W = acceleration_W_m_s2 + kGravity_m_s2 * Vec3::UnitZ();
  thrust_W.z() = std::clamp(thrust_W.z(), parameters.min_thrust_m_s2, parameters.max_thrust_m_s2);
  const double by_tilt = thrust_W.z() * std::tan(parameters.max_tilt_rad);
  const double by_amount =
      std::sqrt(parameters.max_thrust_m_s2 * parameters.max_thrust_m_s2 - thrust_W.z() * thrust_W.z());
  const double most = std::min(by_tilt, by_amount);
  const double horizontal = thrust_W.head<2>().norm();
  if (horizontal > most) thrust_W.head<2>() *= most / horizontal;
  return thrust_W;
}

}  // namespace

Multicopter::Multicopter(const MulticopterParameters& parameters, const Vec3& position_W_m, double yaw_W_rad)
    : parameters_(parameters), position_W_m_(position_W_m), thrust_m_s2_(kGravity_m_s2), yaw_W_rad_(yaw_W_rad) {
  requirePositive(parameters.radius_m, "radius_m");
  requirePositive(parameters.attitude_time_constant_s, "attitude_time_constant_s");
  requirePositive(parameters.thrust_time_constant_s, "thrust_time_constant_s");
  requirePositive(parameters.yaw_time_constant_s, "yaw_time_constant_s");
  requirePositive(parameters.max_tilt_rad, "max_tilt_rad");
  requirePositive(parameters.max_yaw_rate_rad_s, "max_yaw_rate_rad_s");
  requirePositive(parameters.min_thrust_m_s2, "min_thrust_m_s2");
  requirePositive(parameters.max_thrust_m_s2 - kGravity_m_s2, "max_thrust_m_s2 above gravity");
  requirePositive(parameters.drag_1_s, "drag_1_s");
}

void Multicopter::advance(const MulticopterCommand& command, Duration duration) {
  const auto steps = std::max(std::lround(toSeconds(duration) / kStep_s), 1L);
  for (long i = 0; i < steps; ++i) step(command, toSeconds(duration) / static_cast<double>(steps));
}

void Multicopter::step(const MulticopterCommand& command, double step_s) {
  const Quat R_W_B_before = state().T_W_B.rotation;
  const Vec3 wanted_W = allowedThrust(command.acceleration_W_m_s2, parameters_);
  const auto towards = [&](double time_constant_s) { return 1.0 - std::exp(-step_s / time_constant_s); };
  thrust_direction_W_ += towards(parameters_.attitude_time_constant_s) * (wanted_W.normalized() - thrust_direction_W_);
  thrust_direction_W_.normalize();
  thrust_m_s2_ += towards(parameters_.thrust_time_constant_s) * (wanted_W.norm() - thrust_m_s2_);
  const double yaw_rate_rad_s =
      std::clamp(wrapAngle(command.yaw_W_rad - yaw_W_rad_) * towards(parameters_.yaw_time_constant_s) / step_s,
                 -parameters_.max_yaw_rate_rad_s, parameters_.max_yaw_rate_rad_s);
  yaw_W_rad_ = wrapAngle(yaw_W_rad_ + yaw_rate_rad_s * step_s);

  acceleration_W_m_s2_ =
      thrust_m_s2_ * thrust_direction_W_ - kGravity_m_s2 * Vec3::UnitZ() - parameters_.drag_1_s * velocity_W_m_s_;
  position_W_m_ += (velocity_W_m_s_ + acceleration_W_m_s2_ * step_s / 2.0) * step_s;
  velocity_W_m_s_ += acceleration_W_m_s2_ * step_s;

  const Eigen::AngleAxisd turn(R_W_B_before.conjugate() * state().T_W_B.rotation);
  angular_rate_B_rad_s_ = std::remainder(turn.angle(), 2.0 * std::numbers::pi) / step_s * turn.axis();
}

VehicleState Multicopter::state() const {
  const Vec3 by_thrust_W = thrust_m_s2_ * thrust_direction_W_ - kGravity_m_s2 * Vec3::UnitZ();
  return {{attitudeFor(by_thrust_W, yaw_W_rad_), position_W_m_},
          velocity_W_m_s_,
          acceleration_W_m_s2_,
          angular_rate_B_rad_s_};
}

}  // namespace nanomap::simulation
