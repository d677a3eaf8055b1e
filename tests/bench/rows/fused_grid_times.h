#pragma once

#include <string>
#include <vector>

#include "tests/bench/report/scoreboard.h"
#include "tests/bench/rows/chain_fixture.h"

namespace nanomap::bench {

/// OctoMap and its distance map, given the last few frames one after another, with as many distances asked for after
/// each as points are given. Recorded beside the cycle; no row, for it answers another question.
void timeFusedGrid(const ChainFixture& fixture, const std::vector<UncertainPoint>& points_B, Scoreboard& scoreboard,
                   const std::string& where);

}  // namespace nanomap::bench
