#pragma once

#include "core/geometry.h"

namespace nanomap {

/// How uncertain a replay takes the vehicle's place to be after a distance: alike in all directions, growing with it.
struct DeviationModel {
  double start_std_m = 0.05;
  double growth_m_per_m = 0.02;

  [[nodiscard]] Mat3 covariance_m2(double distance_m) const {
    const double std_m = start_std_m + growth_m_per_m * distance_m;
    return std_m * std_m * Mat3::Identity();
  }
};

}  // namespace nanomap
