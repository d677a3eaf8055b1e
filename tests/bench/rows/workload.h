#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tests/bench/frames/scenario.h"
#include "tests/bench/report/contest.h"
#include "tests/bench/report/scoreboard.h"
#include "tests/bench/rows/chain_contests.h"
#include "tests/bench/rows/chain_fixture.h"
#include "tests/bench/rows/effort.h"
#include "tests/bench/rows/index_fixture.h"
#include "tests/bench/rows/plan_times.h"

namespace nanomap::bench {

/// Everything that is measured on one scenario.
class Workload {
 public:
  /// Draws the points and builds the references: seconds.
  Workload(Scenario scenario, const Effort& effort);
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;

  /// Everything that is timed, plans included. They borrow the workload.
  [[nodiscard]] std::vector<Contest> contests() const;

  /// Holds the contests, and measures what is none: plans one by one, memory, exactness.
  void measure(Scoreboard& scoreboard) const;

 private:
  /// Points of one kind, and the chain that they are asked of. Empty if the scenario has none.
  struct Depth {
    std::string name;  ///< the contest's
    std::shared_ptr<const ChainFixture> chain;
    std::vector<Walker> walkers;
    BodyPointSet points_B;
  };

  [[nodiscard]] std::vector<Contest> contestsWithReference() const;
  void addDepths();
  [[nodiscard]] std::vector<Walker> walkers(const ChainFixture& chain, ChainFixture::Trees trees) const;

  Scenario scenario_;
  Effort effort_;
  int cycle_leaf_;  ///< of nanoflann: the best for one build and a plan's queries
  std::shared_ptr<const IndexFixture> index_;
  std::shared_ptr<const IndexFixture> wide_index_;  ///< empty for recorded frames
  std::shared_ptr<const ChainFixture> chain_;
  std::shared_ptr<const ChainFixture> hover_;  ///< empty for recorded frames
  std::vector<Depth> cycles_;
  std::vector<Depth> searches_;  ///< in every view
  std::unique_ptr<PlanTimes> plans_;
};

}  // namespace nanomap::bench
