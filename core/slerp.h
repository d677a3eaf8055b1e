#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace nanomap {

/// Of 1 - cos(angle): up to here slerp() takes its series.
inline constexpr double kGreatestCosineGap = 0x1p-9;

/// Shortest-arc spherical interpolation of unit quaternions: `weight` 0 gives `from`, 1 gives `to`.
/// Neighbours of a stream lie close together. For them, what slerp multiplies the two with, sin(w a) / sin(a) for an
/// angle a between the quaternions, is its power series in x = 1 - cos(a), without a trigonometric function:
/// w (1 + b_1 x (1 + b_2 x (...))), b_i = (i^2 - w^2) / (i (2 i + 1)). Up to kGreatestCosineGap, a turn by 7 degrees,
/// the terms left out are below 4e-16: the last bit. Larger turns take Eigen's way.
/// @pre 0 <= weight <= 1
[[nodiscard]] inline Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to,
                                              double weight) {
  const double cosine = from.dot(to);
  const double x = 1.0 - std::abs(cosine);
  if (!(x <= kGreatestCosineGap)) return from.slerp(weight, to);
  // Both shares at once: of `from` and of `to`.
  const Eigen::Array2d w(1.0 - weight, weight);
  const Eigen::Array2d w2 = w * w;
  const auto b = [&w2](double i) -> Eigen::Array2d { return i / (2.0 * i + 1.0) - w2 * (1.0 / (i * (2.0 * i + 1.0))); };
  const Eigen::Array2d series = 1.0 + x * b(1.0) * (1.0 + x * b(2.0) * (1.0 + x * b(3.0) * (1.0 + x * b(4.0))));
  const Eigen::Array2d shares = w * series;
  return Eigen::Quaterniond(shares[0] * from.coeffs() + std::copysign(shares[1], cosine) * to.coeffs());
}

}  // namespace nanomap
