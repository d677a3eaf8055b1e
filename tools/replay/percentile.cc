#include "tools/replay/percentile.h"

#include <algorithm>
#include <cmath>

namespace nanomap {

Duration percentile(std::vector<Duration> samples, double fraction) {
  if (samples.empty()) return Duration::zero();
  const double rank = std::ceil(fraction * static_cast<double>(samples.size()));
  const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  const auto at = samples.begin() + std::min(index, std::ssize(samples) - 1);
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

}  // namespace nanomap
