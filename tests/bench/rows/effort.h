#pragma once

#include <cstddef>

namespace nanomap::bench {

/// How much is measured. The defaults give figures that repeat; quick() shows that everything works.
struct Effort {
  std::size_t history = 150;
  std::size_t plan_queries = 125 * 20;
  std::size_t nearest_queries = 1000;  ///< of one run
  std::size_t checked_queries = 200;   ///< compared with a linear scan, for each k
  std::size_t plans = 50;              ///< of different states and goals
  int rounds = 5;
  int long_rounds = 3;  ///< of what takes tens of milliseconds

  [[nodiscard]] static Effort quick() {
    return {.history = 12,
            .plan_queries = 100,
            .nearest_queries = 100,
            .checked_queries = 50,
            .plans = 3,
            .rounds = 1,
            .long_rounds = 1};
  }
};

}  // namespace nanomap::bench
