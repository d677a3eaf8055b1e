#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "tests/bench/report/contest.h"
#include "tests/bench/rows/chain_fixture.h"

namespace nanomap::bench {

/// A reference chain and what indexes its frames.
struct Walker {
  std::string name;
  TreeBuilder build;
  std::shared_ptr<SequentialChain> chain;
};

using BodyPointSet = std::shared_ptr<const std::vector<UncertainPoint>>;

/// Which view answers, for points whose search passes over all views: no tree is asked.
[[nodiscard]] Contest locateContest(std::shared_ptr<const ChainFixture> fixture, const Walker& walker,
                                    const std::string& name, BodyPointSet points_B);

/// One frame inserted, and a plan's queries, k = 1.
[[nodiscard]] Contest cycleContest(std::shared_ptr<const ChainFixture> fixture, const std::vector<Walker>& walkers,
                                   const std::string& name, BodyPointSet points_B);

/// Answers of `points_B` that are another view's than the walker's, or another distance beyond what rounding the point
/// into the view's frame explains.
[[nodiscard]] std::size_t countDifferences(const ChainFixture& fixture, const Walker& walker,
                                           const std::vector<UncertainPoint>& points_B);

}  // namespace nanomap::bench
