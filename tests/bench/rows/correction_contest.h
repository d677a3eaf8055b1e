#pragma once

#include <memory>

#include "tests/bench/report/contest.h"
#include "tests/bench/rows/chain_fixture.h"

namespace nanomap::bench {

/// A window over the whole history, as many corrected poses as views but at other moments, applied to the chain.
[[nodiscard]] Contest correctionContest(std::shared_ptr<const ChainFixture> fixture);

}  // namespace nanomap::bench
