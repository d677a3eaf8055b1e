#include "planner/heading.h"

#include <algorithm>
#include <cmath>

#include "core/level_frame.h"

namespace nanomap {

HeadingCommand turn(double yaw_W_rad, double wanted_W_rad, const HeadingParameters& parameters) {
  const double rate_rad_s = std::clamp(wrapAngle(wanted_W_rad - yaw_W_rad) / parameters.reach_s,
                                       -parameters.max_rate_rad_s, parameters.max_rate_rad_s);
  return {wrapAngle(yaw_W_rad + rate_rad_s * parameters.reach_s), rate_rad_s};
}

double sweepOffset(Time time, const HeadingParameters& parameters) {
  const Duration period = fromSeconds(4.0 * parameters.sweep_amplitude_rad / parameters.sweep_rate_rad_s);
  const double phase = toSeconds(time.time_since_epoch() % period) / toSeconds(period);
  return parameters.sweep_amplitude_rad * (1.0 - 4.0 * std::abs(phase - 0.5));
}

HorizontalView horizontalView(const CameraModel& camera) {
  const Vec3 axis_B = camera.parameters().T_B_C.rotation * Vec3::UnitZ();
  const Frustum& frustum = camera.frustum();
  return {std::atan2(axis_B.y(), axis_B.x()), std::atan(std::min(-frustum.tan_left, frustum.tan_right))};
}

}  // namespace nanomap
