#include "firmware_app/configuration/camera_mount.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nanomap {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// R_M_C: an exact cyclic turn of the axes.
const Quat& forwardLooking() {
  static const Quat R_M_C(0.5, -0.5, 0.5, -0.5);
  return R_M_C;
}

}  // namespace

Quat rotationOfMount(const MountAngles& angles) {
  const Quat R_B_M = Eigen::AngleAxisd(angles.yaw_deg / kDegreesPerRadian, Vec3::UnitZ()) *
                     Eigen::AngleAxisd(angles.pitch_deg / kDegreesPerRadian, Vec3::UnitY()) *
                     Eigen::AngleAxisd(angles.roll_deg / kDegreesPerRadian, Vec3::UnitX());
  return R_B_M * forwardLooking();
}

MountAngles anglesOfMount(const Quat& R_B_C) {
  const Mat3 R_B_M = (R_B_C * forwardLooking().conjugate()).normalized().toRotationMatrix();
  const double pitch = std::asin(std::clamp(-R_B_M(2, 0), -1.0, 1.0));
  // Nearer to the vertical than this, rounding decides roll and yaw.
  constexpr double kVertical = 1e-6;
  const bool vertical = std::hypot(R_B_M(0, 0), R_B_M(1, 0)) < kVertical;
  const double roll = vertical ? 0.0 : std::atan2(R_B_M(2, 1), R_B_M(2, 2));
  const double yaw = vertical ? std::atan2(-R_B_M(0, 1), R_B_M(1, 1)) : std::atan2(R_B_M(1, 0), R_B_M(0, 0));
  return {roll * kDegreesPerRadian, pitch * kDegreesPerRadian, yaw * kDegreesPerRadian};
}

}  // namespace nanomap
