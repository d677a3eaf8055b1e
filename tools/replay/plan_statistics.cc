#include "tools/replay/plan_statistics.h"

namespace nanomap {

void PlanStatistics::record(const Decision& decision) {
  ++total_;
  ++by_reason_[static_cast<std::size_t>(decision.reason)];
  candidates_ += decision.candidates;
  evaluated_ += decision.evaluated;
  feasible_ += decision.feasible;
  for (std::size_t i = 0; i < kStatusCount; ++i) by_status_[i] += decision.vetoes.by_status[i];
  by_neighbours_ += decision.vetoes.by_neighbours;
  of_brakes_ += decision.vetoes.of_brakes;
  const bool flies = decision.reason == Reason::kFlying || decision.reason == Reason::kGoingRound ||
                     decision.reason == Reason::kKeeping;
  if (!flies) return;
  flown_risks_.push_back(decision.risk);
  if (!decision.brake_verified) ++flown_without_brake_;
}

}  // namespace nanomap
