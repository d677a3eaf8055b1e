#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace nanomap {

/// The greatest finite float whose square root, rounded, is at most `radius_m`: comparing squares with it is comparing
/// distances with the radius, to the last bit. Empty if no distance is within the radius: it is negative or NaN.
[[nodiscard]] inline std::optional<float> greatestSquareWithin(float radius_m) {
  if (!(radius_m >= 0.0F)) return std::nullopt;
  constexpr float kMost = std::numeric_limits<float>::max();
  const auto above = [](float square) { return std::nextafter(square, std::numeric_limits<float>::infinity()); };
  float square = std::fmin(radius_m * radius_m, kMost);
  while (std::sqrt(square) > radius_m) square = std::nextafter(square, 0.0F);
  while (square < kMost && std::sqrt(above(square)) <= radius_m) square = above(square);
  return square;
}

}  // namespace nanomap
