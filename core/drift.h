#pragma once

#include <cstdint>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// How the relative position error along the chain grows with age.
enum class GrowthLaw : std::uint8_t {
  kSquareRoot,  ///< independent increments: the variance grows with time
  kLinear,      ///< correlated increments (a velocity error): the standard deviation grows with time
};

/// Drift of the estimator: the standard deviation of relative position after a time, and the law between.
/// The accumulated covariance at that age equals it, whatever the frame rate (DESIGN.md "Drift"; paper IV.A.1).
struct DriftModel {
  double horizontal_std_m = 0.2;  ///< along each of W's x and y; the paper's Table I has 0.06 .. 0.25 m in 5 s
  double vertical_std_m = 0.1;    ///< along W's z, which a vehicle measures in other ways as well
  Duration after = std::chrono::seconds(5);
  GrowthLaw law = GrowthLaw::kSquareRoot;
  bool use_increments = false;  ///< take the pose messages' increment covariances where they carry them

  /// Diagonal of the covariance in W [m^2] that relative position has at `age`; zero for ages up to zero.
  [[nodiscard]] Vec3 variance_W(Duration age) const;
};

}  // namespace nanomap
