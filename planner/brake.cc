#include "planner/brake.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nanomap {
namespace {

/// The acceleration of one direction after the first ramp: held, and then ramped to zero.
struct Deceleration {
  double hold_s;
  Vec3 acceleration_m_s2;
};

/// What takes `velocity_m_s` to zero, where that is the velocity if the first ramp ended at zero acceleration.
/// Both ramps add half their length to the hold.
Deceleration decelerate(const Vec3& velocity_m_s, double limit_m_s2, double ramps_s) {
  const double hold_s = std::max(velocity_m_s.norm() / limit_m_s2 - ramps_s / 2.0, 0.0);
  return {hold_s, -velocity_m_s / (hold_s + ramps_s / 2.0)};
}

}  // namespace

Trajectory brakeAfter(const Trajectory& motion, double after_s, const MotionLimits& limits) {
  Trajectory brake = motion.firstPart(after_s);
  const Motion from = brake.atEnd();
  const Vec3& a = from.acceleration_m_s2;

  const double horizontal_limit_m_s2 = limits.horizontal_at_full_m_s2;
  const double vertical_limit_m_s2 = limits.vertical_m_s2;
  const double largest_change_m_s2 =
      std::hypot(a.head<2>().norm() + horizontal_limit_m_s2, std::abs(a.z()) + vertical_limit_m_s2);
  const double ramp_in_s = limits.rampFor_s(largest_change_m_s2);
  const double ramp_out_s = limits.rampFor_s(std::hypot(horizontal_limit_m_s2, vertical_limit_m_s2));

  const Vec3 velocity_m_s = from.velocity_m_s + a * ramp_in_s / 2.0;
  const Vec3 vertical_m_s(0.0, 0.0, velocity_m_s.z());
  const std::array<Deceleration, 2> decelerations = {
      decelerate(velocity_m_s - vertical_m_s, horizontal_limit_m_s2, ramp_in_s + ramp_out_s),
      decelerate(vertical_m_s, vertical_limit_m_s2, ramp_in_s + ramp_out_s)};

  const Vec3 held_m_s2 = decelerations[0].acceleration_m_s2 + decelerations[1].acceleration_m_s2;
  brake.append(ramp_in_s, (held_m_s2 - a) / ramp_in_s);

  // The two ramp out at times of their own: cut time at every end of a hold and of a ramp.
  std::array<double, 4> cuts_s{};
  for (std::size_t i = 0; i < decelerations.size(); ++i) {
    cuts_s[2 * i] = decelerations[i].hold_s;
    cuts_s[2 * i + 1] = decelerations[i].hold_s + ramp_out_s;
  }
  std::sort(cuts_s.begin(), cuts_s.end());
  double begin_s = 0.0;
  for (const double end_s : cuts_s) {
    Vec3 jerk_m_s3 = Vec3::Zero();
    for (const Deceleration& deceleration : decelerations) {
      const bool ramps_out = begin_s >= deceleration.hold_s && begin_s < deceleration.hold_s + ramp_out_s;
      if (ramps_out) jerk_m_s3 -= deceleration.acceleration_m_s2 / ramp_out_s;
    }
    brake.append(end_s - begin_s, jerk_m_s3);
    begin_s = end_s;
  }
  return brake;
}

}  // namespace nanomap
