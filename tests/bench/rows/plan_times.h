#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/goal.h"
#include "core/vehicle_state.h"
#include "planner/planner.h"
#include "tests/bench/report/contest.h"
#include "tests/bench/report/scoreboard.h"
#include "tests/bench/rows/chain_fixture.h"
#include "tests/bench/rows/effort.h"

namespace nanomap::bench {

/// Plans with a full history: the library's 125 primitives with 20 samples each, and their brakes.
class PlanTimes {
 public:
  /// Draws states (up to 8 m/s, about where the camera looks) and goals (30 m away, all around ahead).
  PlanTimes(std::shared_ptr<const ChainFixture> fixture, std::size_t plans);

  /// All plans, with and without early exit.
  [[nodiscard]] Contest contest() const;

  /// Over all plans, each plan's time being its median over some rounds: what is left is what plans differ in, not what
  /// else the machine does.
  struct Spread {
    double median_s;
    double p99_s;
  };
  struct Times {
    Spread exhaustive;
    Spread early_exit;
  };

  /// Measures them, and records them as times that no row is made of.
  Times record(Scoreboard& scoreboard, int rounds, const std::string& where) const;

  /// Rates p99 without early exit and the median with it as well.
  void rate(Scoreboard& scoreboard, int rounds, const std::string& where) const;

 private:
  struct Task {
    VehicleState state;
    std::optional<Goal> goal;
  };
  [[nodiscard]] Decision plan(const Planner& planner, const Task& task) const;
  [[nodiscard]] std::vector<double> times_s(const Planner& planner, int rounds) const;

  std::shared_ptr<const ChainFixture> fixture_;
  std::vector<Task> tasks_;
  Planner exhaustive_;
  Planner early_;
};

}  // namespace nanomap::bench
