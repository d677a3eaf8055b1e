#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/decision.h"

namespace nanomap {

/// What the decisions of a replay have in common.
class PlanStatistics {
 public:
  void record(const Decision& decision);

  [[nodiscard]] std::uint64_t total() const { return total_; }
  [[nodiscard]] std::uint64_t because(Reason reason) const { return by_reason_[static_cast<std::size_t>(reason)]; }

  /// Candidates over all decisions: considered, evaluated, feasible, and what vetoed those that were not.
  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }
  [[nodiscard]] std::uint64_t evaluated() const { return evaluated_; }
  [[nodiscard]] std::uint64_t feasible() const { return feasible_; }
  [[nodiscard]] std::uint64_t vetoedBy(Status status) const { return by_status_[static_cast<std::size_t>(status)]; }
  [[nodiscard]] std::uint64_t vetoedByNeighbours() const { return by_neighbours_; }
  [[nodiscard]] std::uint64_t vetoesOfBrakes() const { return of_brakes_; }

  /// Of the decisions that fly towards the goal, in their order.
  [[nodiscard]] const std::vector<double>& flownRisks() const { return flown_risks_; }
  [[nodiscard]] std::uint64_t flownWithoutBrake() const { return flown_without_brake_; }

 private:
  std::uint64_t total_ = 0;
  std::array<std::uint64_t, kReasonCount> by_reason_{};
  std::uint64_t candidates_ = 0;
  std::uint64_t evaluated_ = 0;
  std::uint64_t feasible_ = 0;
  std::array<std::uint64_t, kStatusCount> by_status_{};
  std::uint64_t by_neighbours_ = 0;
  std::uint64_t of_brakes_ = 0;
  std::vector<double> flown_risks_;
  std::uint64_t flown_without_brake_ = 0;
};

}  // namespace nanomap
