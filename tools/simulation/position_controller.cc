#include "tools/simulation/position_controller.h"

namespace nanomap::simulation {

Vec3 PositionController::acceleration(const Motion& setpoint, const Motion& estimated, Duration since) {
  const Vec3 wanted_m_s =
      setpoint.velocity_m_s + parameters_.position_1_s.cwiseProduct(setpoint.position_m - estimated.position_m);
  const Vec3 error_m_s = wanted_m_s - estimated.velocity_m_s;
  integral_m_s2_ += toSeconds(since) * parameters_.integral_1_s2.cwiseProduct(error_m_s);
  integral_m_s2_ = integral_m_s2_.cwiseMax(-parameters_.max_integral_m_s2).cwiseMin(parameters_.max_integral_m_s2);
  return setpoint.acceleration_m_s2 + parameters_.velocity_1_s.cwiseProduct(error_m_s) + integral_m_s2_;
}

}  // namespace nanomap::simulation
