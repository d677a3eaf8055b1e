#pragma once

#include "core/geometry.h"

namespace nanomap {

/// How far a vehicle is beside the motion that it has been told, and how it is taken to come back to it: evenly, give
/// or take a quarter of what it has come back by. Loops of autopilots come back sooner or later than that, and not all
/// the way in a steady wind.
struct Aside {
  Vec3 at_start_W_m = Vec3::Zero();  ///< from where it should be when a plan starts to where it is
  double recovery_s = 0.0;           ///< 0: it is where it should be, whatever at_start_W_m says

  /// From where it should be to where it is expected.
  [[nodiscard]] Vec3 at(double elapsed_s) const { return left(elapsed_s) * at_start_W_m; }

  /// Along this it is uncertain by as much: a standard deviation.
  [[nodiscard]] Vec3 deviation(double elapsed_s) const {
    constexpr double kOfReturn = 0.25;
    if (recovery_s == 0.0) return Vec3::Zero();
    return kOfReturn * (1.0 - left(elapsed_s)) * at_start_W_m;
  }

  /// Is it expected where it should be, from then on?
  [[nodiscard]] bool isBackAt(double elapsed_s) const { return elapsed_s >= recovery_s || at_start_W_m.isZero(0.0); }

 private:
  [[nodiscard]] double left(double elapsed_s) const {
    return elapsed_s < recovery_s ? 1.0 - elapsed_s / recovery_s : 0.0;
  }
};

}  // namespace nanomap
