#pragma once

#include <optional>

#include "core/decision.h"
#include "core/goal.h"
#include "core/snapshot.h"
#include "core/vehicle_state.h"

namespace nanomap {

/// No number in it is beyond all reason, and its attitude is one.
[[nodiscard]] bool isPlausible(const VehicleState& state);

/// Why nothing can be planned from the state, if so.
[[nodiscard]] std::optional<Reason> stateFault(const VehicleState& state, const ChainSnapshot& snapshot, Time now,
                                               Duration max_state_age);

/// Why the vehicle cannot be sent to the goal, if so.
[[nodiscard]] std::optional<Reason> goalFault(const std::optional<Goal>& goal, const VehicleState& state);

}  // namespace nanomap
