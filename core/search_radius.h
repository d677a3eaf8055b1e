#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace nanomap {

/// The greatest finite float whose square root, rounded, is at most `radius_m`: comparing squares with it is comparing
/// distances with the radius, to the last bit. Empty if no distance is within the radius: it is negative or NaN.
[[nodiscard]] inline std::optional<float> greatestSquareWithin(float radius_m) {
  if (!(radius_m >= 0.0F)) return std::nullopt;
  constexpr float kMost = std::numeric_limits<float>::max();
  if (radius_m * radius_m >= kMost) return kMost;
  // Neighbours among floats that are not negative: their bits count upwards.
  const auto next = [](float square) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(square) + 1); };
  const auto previous = [](float square) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(square) - 1); };
  float square = radius_m * radius_m;
  while (std::sqrt(square) > radius_m) square = previous(square);
  while (std::sqrt(next(square)) <= radius_m) square = next(square);
  return square;
}

}  // namespace nanomap
