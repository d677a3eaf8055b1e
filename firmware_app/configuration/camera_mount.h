#pragma once

#include "core/geometry.h"

namespace nanomap {

/// How a camera is turned against one that looks straight ahead, in degrees: roll about x (forward), then pitch about
/// y (left; positive tilts the view down), then yaw about z (up; positive turns it left), all about the body's own axes
/// (FLU): R_B_M = Rz(yaw) * Ry(pitch) * Rx(roll).
struct MountAngles {
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
};

/// R_B_C = R_B_M * R_M_C, where R_M_C takes the camera's axes (RDF) to those of a body that looks the same way (FLU):
/// C's x (right) is -y, C's y (down) is -z, C's z (forward) is x.
[[nodiscard]] Quat rotationOfMount(const MountAngles& angles);

/// The inverse. With the view straight up or down, where roll and yaw are one, roll is 0.
[[nodiscard]] MountAngles anglesOfMount(const Quat& R_B_C);

}  // namespace nanomap
