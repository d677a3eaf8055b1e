#pragma once

#include <gtest/gtest.h>

#include "tools/sim/lockstep_flight.h"

namespace nanomap::sim {

inline constexpr double kVehicleRadius_m = 0.4;

/// It stands at the goal, has touched nothing, and neither planner nor autopilot had to give up.
inline void expectAtTheGoal(const LockstepFlight& flight) {
  const LockstepSummary& flown = flight.flown;
  EXPECT_EQ(flown.outcome, Outcome::kAtGoal) << "seed " << flight.seed;
  EXPECT_GE(flown.min_clearance_m, kVehicleRadius_m) << "seed " << flight.seed;
  EXPECT_EQ(flown.plans.flownWithoutBrake(), 0U) << "seed " << flight.seed;
  EXPECT_EQ(flown.failsafes, 0U) << "seed " << flight.seed;
}

}  // namespace nanomap::sim
