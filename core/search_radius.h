#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

namespace nanomap {

/// The greatest finite float whose square root, rounded, is at most `radius_m`: comparing squares with it is comparing
/// distances with the radius, to the last bit. Empty if no distance is within the radius: it is negative or NaN.
///
/// A root is rounded to the radius or less if it is at most halfway to the next float. That half has 25 bits and its
/// square 50, which a double holds; being odd in its last bit it is the square of no float, so that there are no ties.
[[nodiscard]] inline std::optional<float> greatestSquareWithin(float radius_m) {
  if (!(radius_m >= 0.0F)) return std::nullopt;
  constexpr float kMost = std::numeric_limits<float>::max();
  if (radius_m * radius_m >= kMost) return kMost;
  // Neighbours among floats that are not negative: their bits count upwards.
  const auto neighbour = [](float of, std::uint32_t up) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(of) + up);
  };
  const double half_m = 0.5 * (static_cast<double>(radius_m) + static_cast<double>(neighbour(radius_m, 1U)));
  const double bound_m2 = half_m * half_m;
  const auto nearest_m2 = static_cast<float>(bound_m2);
  constexpr std::uint32_t kDown = ~0U;
  return static_cast<double>(nearest_m2) <= bound_m2 ? nearest_m2 : neighbour(nearest_m2, kDown);
}

}  // namespace nanomap
