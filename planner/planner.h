#pragma once

#include <optional>

#include "core/decision.h"
#include "core/goal.h"
#include "core/snapshot.h"
#include "core/vehicle_state.h"
#include "planner/explanation.h"
#include "planner/planner_parameters.h"
#include "planner/primitive_library.h"

namespace nanomap {

/// What is flown already, and how the vehicle follows it.
struct InForce {
  /// From the plan's start on: where nothing better is verified, the stop it leads to is still the one that was. Null:
  /// nothing is kept. Borrowed.
  const Trajectory* rest = nullptr;
  Vec3 aside_W_m = Vec3::Zero();  ///< from where the state says to where the vehicle is
};

/// Chooses a motion primitive under a collision-chance constraint, together with a brake that was verified with it
/// (paper V.A; WAFR 2016). A function of its arguments and parameters: it keeps nothing from one plan to the next.
/// Threads: immutable, any number of callers.
class Planner {
 public:
  /// @throws std::invalid_argument naming the parameter
  explicit Planner(const PlannerParameters& parameters);

  /// What to fly from `now` on. Whatever is wrong with state or goal, the decision says so.
  /// @param now       at or shortly after the state's stamp: the state is carried on to it at constant acceleration
  /// @param in_force  what is flown from `now` on, which the state is then on, and how far the vehicle is beside it
  /// Allocates: no, except inside FLANN.
  [[nodiscard]] Decision plan(const ChainSnapshot& snapshot, const VehicleState& state, const std::optional<Goal>& goal,
                              Time now, const InForce& in_force = {}) const;

  /// The same decision, and what every candidate was judged by. Evaluates everything, and allocates: not for flight.
  [[nodiscard]] Explanation explain(const ChainSnapshot& snapshot, const VehicleState& state,
                                    const std::optional<Goal>& goal, Time now, const InForce& in_force = {}) const;

  [[nodiscard]] const PlannerParameters& parameters() const { return parameters_; }

 private:
  PlannerParameters parameters_;
  PrimitiveLibrary library_;
};

}  // namespace nanomap
