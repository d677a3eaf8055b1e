#include "tools/doctor/mount_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware_app/configuration/camera_mount.h"

namespace nanomap::doctor {
namespace {

constexpr double kAlike_rad = 0.02;

/// The 24 rotations that take a cube to itself: x to any of six directions, and y to any of the four beside it.
std::vector<Quat> cubeRotations() {
  const std::array<Vec3, 6> axes = {Vec3::UnitX(),  Vec3::UnitY(),  Vec3::UnitZ(),
                                    -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};
  std::vector<Quat> rotations;
  for (const Vec3& x : axes) {
    for (const Vec3& y : axes) {
      if (std::abs(x.dot(y)) > 0.5) continue;
      Mat3 rotation;
      rotation << x, y, x.cross(y);
      rotations.emplace_back(rotation);
    }
  }
  return rotations;
}

void addUnlessAlike(std::vector<MountTrial>& trials, const Quat& configured, Quat R_B_C, std::string mistake) {
  const auto alike = [&](const Quat& other) { return R_B_C.angularDistance(other) < kAlike_rad; };
  if (alike(configured) || std::ranges::any_of(trials, alike, &MountTrial::R_B_C)) return;
  trials.push_back({R_B_C.normalized(), std::move(mistake)});
}

}  // namespace

std::vector<MountTrial> mountTrials(const Quat& R_B_C) {
  std::vector<MountTrial> trials;
  const MountAngles angles = anglesOfMount(R_B_C);
  addUnlessAlike(trials, R_B_C, rotationOfMount({angles.roll_deg, -angles.pitch_deg, angles.yaw_deg}),
                 "the sign of its pitch is wrong");
  addUnlessAlike(trials, R_B_C, rotationOfMount({-angles.roll_deg, angles.pitch_deg, angles.yaw_deg}),
                 "the sign of its roll is wrong");
  addUnlessAlike(trials, R_B_C, rotationOfMount({angles.roll_deg, angles.pitch_deg, -angles.yaw_deg}),
                 "the sign of its yaw is wrong");
  for (const Quat& turn : cubeRotations()) {
    const std::string mistake = fmt::format("the camera is turned by {:.0f} degrees",
                                            Eigen::AngleAxisd(turn).angle() * 180.0 / std::numbers::pi);
    addUnlessAlike(trials, R_B_C, turn * R_B_C, mistake);
    addUnlessAlike(trials, R_B_C, R_B_C * turn, mistake);
  }
  return trials;
}

}  // namespace nanomap::doctor
