#pragma once

#include <array>
#include <cstdint>
#include <random>

namespace nanomap::simulation {

/// Every random number of a simulation comes from one of these, seeded by the caller.
using Random = std::mt19937_64;

[[nodiscard]] inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

[[nodiscard]] inline bool chance(Random& random, double probability) {
  return std::bernoulli_distribution(probability)(random);
}

/// A seed of its own for each part of a simulation that was given one seed.
[[nodiscard]] inline std::uint64_t derivedSeed(std::uint64_t seed, std::uint32_t part) {
  constexpr std::uint64_t kLowHalf = 0xffffffffU;
  std::seed_seq sequence{seed & kLowHalf, seed >> 32U, std::uint64_t{part}};
  std::array<std::uint32_t, 2> halves{};
  sequence.generate(halves.begin(), halves.end());
  return (std::uint64_t{halves[1]} << 32U) | halves[0];
}

}  // namespace nanomap::simulation
