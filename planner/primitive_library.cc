#include "planner/primitive_library.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace nanomap {

PrimitiveLibrary::PrimitiveLibrary() {
  std::uint32_t index = 0;
  for (std::uint32_t level = 0; level < kVerticalLevels; ++level) {
    const double up = 2.0 * level / (kVerticalLevels - 1) - 1.0;
    unit_accelerations_L_[index++] = Vec3(0.0, 0.0, up);
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
      const double radius = static_cast<double>(ring) / kRings;
      for (std::uint32_t direction = 0; direction < kDirections; ++direction) {
        const double angle_rad = 2.0 * std::numbers::pi * direction / kDirections;
        unit_accelerations_L_[index++] = Vec3(radius * std::cos(angle_rad), radius * std::sin(angle_rad), up);
      }
    }
  }
}

Vec3 PrimitiveLibrary::acceleration_L(std::uint32_t index, const MotionLimits& limits, double speed_m_s) const {
  assert(index < kLibrarySize);
  const double horizontal_m_s2 = limits.horizontal_m_s2(speed_m_s);
  return unit_accelerations_L_[index].cwiseProduct(Vec3(horizontal_m_s2, horizontal_m_s2, limits.vertical_m_s2));
}

Vec3 goalDirectedAcceleration(const Vec3& to_goal_m, const Vec3& velocity_m_s, double top_speed_m_s,
                              const GoalDirectedParameters& parameters, const MotionLimits& limits) {
  const double distance_m = to_goal_m.norm();
  const double wanted_m_s = std::min(top_speed_m_s, distance_m / parameters.approach_s);
  const Vec3 direction = distance_m > 0.0 ? Vec3(to_goal_m / distance_m) : Vec3::Zero();
  Vec3 acceleration_m_s2 = (wanted_m_s * direction - velocity_m_s) / parameters.response_s;
  const double horizontal_m_s2 = acceleration_m_s2.head<2>().norm();
  const double limit_m_s2 = limits.horizontal_m_s2(velocity_m_s.norm());
  if (horizontal_m_s2 > limit_m_s2) acceleration_m_s2.head<2>() *= limit_m_s2 / horizontal_m_s2;
  acceleration_m_s2.z() = std::clamp(acceleration_m_s2.z(), -limits.vertical_m_s2, limits.vertical_m_s2);
  return acceleration_m_s2;
}

Trajectory primitive(Time start, const Motion& at_start_W, const Vec3& acceleration_W_m_s2, const PrimitiveTimes& times,
                     const MotionLimits& limits) {
  const Vec3 change_m_s2 = acceleration_W_m_s2 - at_start_W.acceleration_m_s2;
  const double ramp_in_s = limits.rampFor_s(change_m_s2.norm());
  const double ramp_out_s = limits.rampFor_s(acceleration_W_m_s2.norm());
  const double pushed_s = std::max(ramp_in_s, times.push_s);
  Trajectory trajectory(start, at_start_W);
  trajectory.append(ramp_in_s, change_m_s2 / ramp_in_s);
  trajectory.append(pushed_s - ramp_in_s, Vec3::Zero());
  trajectory.append(ramp_out_s, -acceleration_W_m_s2 / ramp_out_s);
  trajectory.append(std::max(times.horizon_s - pushed_s - ramp_out_s, 0.0), Vec3::Zero());
  return trajectory.firstPart(times.horizon_s);
}

}  // namespace nanomap
