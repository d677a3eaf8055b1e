#pragma once

#include <cstddef>
#include <string>

#include "tests/bench/report/scoreboard.h"
#include "tests/bench/rows/index_fixture.h"

namespace nanomap::bench {

/// Compares ours with a linear scan: k = 1, 10, 16, and k = 10 within 1 m, for `count` points of each set and as many
/// around the camera, to the last bit. Remarks it if a reference is not exact either.
void rateExactness(const IndexFixture& fixture, std::size_t count, Scoreboard& scoreboard, const std::string& where);

}  // namespace nanomap::bench
