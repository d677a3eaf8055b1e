#pragma once

#include <vector>

#include "core/time.h"

namespace nanomap {

/// Nearest-rank percentile: the smallest sample that at least `fraction` of the samples do not exceed. 1 is the
/// largest; 0 without samples.
/// @param fraction  above 0, up to 1
[[nodiscard]] Duration percentile(std::vector<Duration> samples, double fraction);

}  // namespace nanomap
