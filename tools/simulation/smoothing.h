#pragma once

#include <cstddef>
#include <vector>

namespace nanomap::simulation {

/// Running mean over 2 * half_width + 1 samples, three times: close to a Gaussian, twice differentiable, and a bound on
/// the input's derivatives still holds for the output's. Both ends stay where they are: the samples are continued
/// beyond them by point reflection.
template <typename Value>
[[nodiscard]] std::vector<Value> smooth(std::vector<Value> samples, std::size_t half_width) {
  constexpr int kPasses = 3;
  const auto half = static_cast<std::ptrdiff_t>(half_width);
  const auto last = static_cast<std::ptrdiff_t>(samples.size()) - 1;
  if (last < half || half == 0) return samples;
  std::vector<Value> means(samples.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto sample = [&](std::ptrdiff_t i) -> Value {
      const auto at = [&](std::ptrdiff_t j) -> const Value& { return samples[static_cast<std::size_t>(j)]; };
      if (i < 0) return 2.0 * at(0) - at(-i);
      if (i > last) return 2.0 * at(last) - at(2 * last - i);
      return at(i);
    };
    Value sum = sample(-half);
    for (std::ptrdiff_t i = 1 - half; i <= half; ++i) sum += sample(i);
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
      means[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * half + 1);
      sum += sample(i + half + 1) - sample(i - half);
    }
    samples.swap(means);
  }
  return samples;
}

}  // namespace nanomap::simulation
