#pragma once

#include <cmath>

#include "core/geometry.h"
#include "core/level_frame.h"

/// Between NanoMap's frames, z up (W, body FLU), and the autopilot's, z down (LOCAL_NED, body FRD). Nothing outside
/// drivers/mavlink knows the latter.
namespace nanomap {

/// The same vector in FRD instead of FLU axes, and back: half a turn about x.
[[nodiscard]] inline Vec3 flipped(const Vec3& v) { return {v.x(), -v.y(), -v.z()}; }

/// The same rotation between FRD axes instead of FLU axes on both sides, and back.
[[nodiscard]] inline Quat flipped(const Quat& R) { return {R.w(), R.x(), -R.y(), -R.z()}; }

/// T_NED_W. Both frames are level, so that it is a heading and an offset.
class NedFromWorld {
 public:
  /// @param heading_rad        of W's x axis, clockwise from north
  /// @param translation_NED_m  W's origin in NED
  NedFromWorld(double heading_rad, const Vec3& translation_NED_m)
      : heading_rad_(wrapAngle(heading_rad)),
        T_NED_W_{Quat(Eigen::AngleAxisd(heading_rad, Vec3::UnitZ())) * Quat(0.0, 1.0, 0.0, 0.0), translation_NED_m} {}
  NedFromWorld() : NedFromWorld(0.0, Vec3::Zero()) {}

  [[nodiscard]] double heading_rad() const { return heading_rad_; }
  [[nodiscard]] const Pose& pose() const { return T_NED_W_; }

  [[nodiscard]] Vec3 point(const Vec3& p_W) const { return T_NED_W_ * p_W; }
  /// Velocities and accelerations.
  [[nodiscard]] Vec3 direction(const Vec3& v_W) const { return T_NED_W_.rotation * v_W; }
  /// Heading in NED [rad, clockwise from north] of a yaw in W [rad, from x towards y]; and back.
  [[nodiscard]] double heading(double yaw_rad) const { return wrapAngle(heading_rad_ - yaw_rad); }

  [[nodiscard]] Vec3 pointInWorld(const Vec3& p_NED) const { return T_NED_W_.inverse() * p_NED; }
  [[nodiscard]] Vec3 directionInWorld(const Vec3& v_NED) const { return T_NED_W_.rotation.conjugate() * v_NED; }

 private:
  double heading_rad_;
  Pose T_NED_W_;
};

}  // namespace nanomap
