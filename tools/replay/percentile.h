#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/time.h"

namespace nanomap {

/// Nearest-rank percentile: the smallest sample that at least `fraction` of the samples do not exceed. 1 is the
/// largest; a sample's zero without samples.
/// @param fraction  above 0, up to 1
template <class Sample = Duration>
[[nodiscard]] Sample percentile(std::vector<Sample> samples, double fraction) {
  if (samples.empty()) return Sample{};
  const double rank = std::ceil(fraction * static_cast<double>(samples.size()));
  const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  const auto at = samples.begin() + std::min(index, std::ssize(samples) - 1);
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

}  // namespace nanomap
