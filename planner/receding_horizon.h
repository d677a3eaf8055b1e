#pragma once

#include <optional>

#include "core/decision.h"
#include "planner/arrival.h"
#include "planner/detour.h"
#include "planner/explanation.h"
#include "planner/planner.h"

namespace nanomap {

/// Planning again and again while the vehicle flies what was planned before: holds the decision in force, and starts
/// each plan from it, so that places and velocities of one plan join those of the next without a step.
///
/// The decision in force is the last one that may be flown (`isFlyable`), and what is flown of it is its brake, which
/// is the chosen motion for the planner's `brake_after_s` and then leads to a standstill: nothing has to be switched
/// when no new plan comes. The vehicle follows it if its measured position and velocity are within the planner's
/// tracking tolerances of it; the plan then starts from the motion in force at `now`, and what is left of that, judged
/// anew, is one of its candidates: a stop that was verified can be flown to its end. Judged is where the vehicle is,
/// and not where it should be, until it may be expected there (tracking.recovery_s). Else it starts from the state as
/// measured: after a jump of the estimator, in a hand that carries the vehicle, over a recording of someone else's
/// flight.
///
/// What is steered for is the goal; once there, the place where the vehicle stands (planner/arrival.h); on a detour
/// what that says (planner/detour.h). A function of what it was given, in that order. Allocates: no, except inside
/// FLANN. Threads: one.
class RecedingHorizon {
 public:
  /// @throws std::invalid_argument naming the parameter that is wrong
  explicit RecedingHorizon(const PlannerParameters& parameters)
      : planner_(parameters), arrival_(parameters.objective.goal_tolerance_m), detour_(parameters.detour) {}

  /// Plans for `now` and takes the decision into force if it may be flown.
  /// @param measured  as the estimator last said
  [[nodiscard]] Decision step(const ChainSnapshot& snapshot, const VehicleState& measured,
                              const std::optional<Goal>& goal, Time now);

  /// Nothing is in force any more: the vehicle is in someone else's hands.
  void release();

  /// What `step` would decide with the same arguments, and why. Takes nothing into force.
  [[nodiscard]] Explanation explain(const ChainSnapshot& snapshot, const VehicleState& measured,
                                    const std::optional<Goal>& goal, Time now) const;

  /// The state that a plan for `now` starts from.
  [[nodiscard]] VehicleState startState(const VehicleState& measured, Time now) const;

  /// What is flown at `time`: position, velocity and acceleration in W of `inForce()->consumed.epoch`; at a standstill
  /// from the end of the brake on. Empty before the first decision that may be flown.
  [[nodiscard]] std::optional<Motion> motionAt(Time time) const;

  [[nodiscard]] const std::optional<Decision>& inForce() const { return in_force_; }

 private:
  [[nodiscard]] Motion expectedAt(Time stamp) const;
  [[nodiscard]] bool follows(const VehicleState& measured, Time now) const;
  /// From where the vehicle should be to where it is [m, W]; zero where the plan starts from the state as measured.
  [[nodiscard]] Vec3 asideOf(const VehicleState& measured, Time now) const;
  [[nodiscard]] std::optional<Trajectory> restInForce(const VehicleState& measured, Time now) const;

  Planner planner_;
  Arrival arrival_;
  Detour detour_;
  std::optional<Decision> in_force_;
};

/// May it be flown? Not a decision that has no motion, or whose motion is a mere attempt to stop where nothing is known
/// to be safe: then the one before stays in force.
[[nodiscard]] bool isFlyable(const Decision& decision);

}  // namespace nanomap
