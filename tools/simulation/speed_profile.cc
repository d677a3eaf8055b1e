#include "tools/simulation/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nanomap::simulation {
namespace {

/// What is left for gaining or losing speed while the path bends.
double accelerationLeft(double speed_m_s, double curvature_per_m, double max_acceleration_m_s2) {
  const double across_m_s2 = speed_m_s * speed_m_s * curvature_per_m;
  return std::sqrt(std::max(max_acceleration_m_s2 * max_acceleration_m_s2 - across_m_s2 * across_m_s2, 0.0));
}

}  // namespace

std::vector<double> speedProfile(double step_m, const std::vector<double>& curvature_per_m,
                                 std::vector<double> wanted_m_s, const SpeedLimits& limits) {
  // A bend may take this share of the acceleration, so that some is left for braking into and out of it.
  constexpr double kShareAcross = 0.7;
  constexpr double kStraight_per_m = 1e-6;
  const std::size_t count = wanted_m_s.size();
  std::vector<double> speed_m_s = std::move(wanted_m_s);
  for (std::size_t i = 0; i < count; ++i) {
    const double curvature = std::max(std::abs(curvature_per_m[i]), kStraight_per_m);
    speed_m_s[i] = std::min({speed_m_s[i], std::sqrt(kShareAcross * limits.max_acceleration_m_s2 / curvature),
                             limits.max_yaw_rate_rad_s / curvature});
  }
  speed_m_s.front() = 0.0;
  speed_m_s.back() = 0.0;
  for (std::size_t i = 1; i < count; ++i) {
    const double along_m_s2 =
        std::min(limits.max_speed_up_m_s2,
                 accelerationLeft(speed_m_s[i - 1], curvature_per_m[i - 1], limits.max_acceleration_m_s2));
    speed_m_s[i] = std::min(speed_m_s[i], std::sqrt(speed_m_s[i - 1] * speed_m_s[i - 1] + 2.0 * along_m_s2 * step_m));
  }
  for (std::size_t i = count - 1; i-- > 0;) {
    const double along_m_s2 = accelerationLeft(speed_m_s[i + 1], curvature_per_m[i + 1], limits.max_acceleration_m_s2);
    speed_m_s[i] = std::min(speed_m_s[i], std::sqrt(speed_m_s[i + 1] * speed_m_s[i + 1] + 2.0 * along_m_s2 * step_m));
  }
  return speed_m_s;
}

}  // namespace nanomap::simulation
