#pragma once

namespace nanomap {

/// How hard the vehicle may be pushed. Horizontal means within W's xy plane.
struct MotionLimits {
  double horizontal_at_rest_m_s2 = 2.5;
  double horizontal_at_full_m_s2 = 7.5;  ///< from the full speed on; a brake may use it at any speed
  double full_speed_m_s = 10.0;
  double top_speed_m_s = 12.0;  ///< no goal's is higher; soft, as a goal's is
  double vertical_m_s2 = 2.5;
  double ramp_s = 0.2;      ///< from one acceleration to another, unless the jerk limit asks for more
  double jerk_m_s3 = 80.0;  ///< just above full forward to full back in one ramp

  /// Horizontal acceleration of a primitive that starts at `speed_m_s` [m/s^2]: linear up to the full speed.
  [[nodiscard]] double horizontal_m_s2(double speed_m_s) const;

  /// Least time to change an acceleration by `change_m_s2` (a norm) [s].
  [[nodiscard]] double rampFor_s(double change_m_s2) const;
};

}  // namespace nanomap
