#pragma once

#include "core/geometry.h"

namespace nanomap {

/// The rotation nearest to `R` (Frobenius): recorded matrices carry the rounding of their text and the drift of
/// products, up to some 1e-4 an entry.
/// @throws std::invalid_argument if `R` is not finite, mirrors, or is off by more than 0.01 in an entry
[[nodiscard]] Quat nearestRotation(const Mat3& R);

/// `q` with unit norm. @throws std::invalid_argument if it is not finite or its norm is off by more than 0.01
[[nodiscard]] Quat unitQuaternion(const Quat& q);

}  // namespace nanomap
