#pragma once

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

}  // namespace nanomap::simulation
