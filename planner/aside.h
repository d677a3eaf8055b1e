#pragma once

#include <algorithm>

#include "core/geometry.h"

namespace nanomap {

/// How far a vehicle is beside the motion that it has been told, and how it comes back to it: evenly.
struct Aside {
  Vec3 at_start_W_m = Vec3::Zero();  ///< from where it should be when a plan starts to where it is
  double recovery_s = 0.0;           ///< 0: it is back at once, and its start is not beside the motion either

  [[nodiscard]] Vec3 at(double elapsed_s) const {
    if (!(elapsed_s < recovery_s)) return Vec3::Zero();
    return (1.0 - elapsed_s / recovery_s) * at_start_W_m;
  }
};

}  // namespace nanomap
