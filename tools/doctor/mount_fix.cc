#include "tools/doctor/mount_fix.h"

#include <fmt/format.h>

#include <cmath>

#include "firmware_app/configuration/camera_mount.h"

namespace nanomap::doctor {

std::string mountFix(const Facts& facts, const Quat& R_B_C) {
  const auto tidy = [](double angle_deg) { return std::round(angle_deg * 10.0) / 10.0 + 0.0; };
  const MountAngles angles = anglesOfMount(R_B_C);
  const std::string key = fmt::format("camera.mount_roll_pitch_yaw_deg = [{:g}, {:g}, {:g}]", tidy(angles.roll_deg),
                                      tidy(angles.pitch_deg), tidy(angles.yaw_deg));
  if (facts.configuration.camera) return key;
  Quat q = R_B_C;
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();  // the same rotation, as people write it
  return fmt::format(
      "in the camera's message body_from_camera.rotation = [{:.4g}, {:.4g}, {:.4g}, {:.4g}] (w, x, y, z); "
      "or in [camera], {}",
      q.w(), q.x(), q.y(), q.z(), key);
}

}  // namespace nanomap::doctor
