#include "tools/replay/fan.h"

#include <cmath>

#include "core/level_frame.h"

namespace nanomap {
namespace {

/// `count` values over -max .. max, ends included; a single one is 0.
double spread(int i, int count, double max) { return count == 1 ? 0.0 : max * (2.0 * i / (count - 1) - 1.0); }

/// Point in L [m] at `distance_m` along the arc whose chord after `range_m` has the direction `heading_rad`.
Vec3 onMotion(double heading_rad, double climb_rad, double distance_m, double range_m) {
  // The chord of an arc points half as far aside as the arc has turned.
  const double turned_rad = 2.0 * heading_rad * distance_m / range_m;
  const double along_m = distance_m * std::cos(climb_rad);
  const double height_m = distance_m * std::sin(climb_rad);
  if (turned_rad == 0.0) return {along_m, 0.0, height_m};
  const double radius_m = along_m / turned_rad;
  return {radius_m * std::sin(turned_rad), radius_m * (1.0 - std::cos(turned_rad)), height_m};
}

}  // namespace

std::vector<UncertainPoint> fanPoints(const FanParameters& parameters, const Quat& R_W_B, double range_m) {
  const Mat3 R_B_L = R_W_B.conjugate().toRotationMatrix() * levelAxes(yawOf(R_W_B));
  std::vector<UncertainPoint> points_B;
  points_B.reserve(static_cast<std::size_t>(parameters.headings) * static_cast<std::size_t>(parameters.climbs) *
                   static_cast<std::size_t>(parameters.samples));
  for (int climb = 0; climb < parameters.climbs; ++climb) {
    const double climb_rad = spread(climb, parameters.climbs, parameters.max_climb_rad);
    for (int heading = 0; heading < parameters.headings; ++heading) {
      const double heading_rad = spread(heading, parameters.headings, parameters.max_heading_rad);
      for (int sample = 1; sample <= parameters.samples; ++sample) {
        const double distance_m = range_m * sample / parameters.samples;
        points_B.push_back({R_B_L * onMotion(heading_rad, climb_rad, distance_m, range_m),
                            parameters.deviation.covariance_m2(distance_m)});
      }
    }
  }
  return points_B;
}

}  // namespace nanomap
