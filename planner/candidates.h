#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/goal.h"
#include "core/snapshot.h"
#include "planner/aside.h"
#include "planner/objective.h"
#include "planner/planner_parameters.h"
#include "planner/primitive_library.h"
#include "planner/trajectory_risk.h"

namespace nanomap {

/// A candidate before any query.
struct Proposal {
  std::uint32_t index = 0;
  double reward = 0.0;  ///< the objective without risk, which bounds it from above
};

/// What queries said about a candidate.
struct Verdict {
  TrajectoryRisk motion;
  std::optional<TrajectoryRisk> stop;  ///< of its brake, if the motion has no veto and that was checked
  std::optional<VetoCause> veto;       ///< empty: feasible

  [[nodiscard]] bool vetoedByBrake() const { return veto && stop; }
};

/// Everything that a verdict rests on, sample by sample.
struct Evidence {
  std::vector<SampleEvidence> motion;
  std::vector<SampleEvidence> brake;
};

/// The candidates of one plan: all that start with one motion and lead to one goal. They are laid out in frame L (B's
/// origin and yaw, z up) and handed out in W. Borrows the first three arguments of its constructor, and the last.
/// Allocates: no, except inside FLANN and for evidence. Threads: any number of readers.
class Candidates {
 public:
  /// @param aside     where the vehicle is beside `at_start_W`
  /// @param in_force  what is flown already, from `start` and `at_start_W` on; null: nothing is
  Candidates(const PlannerParameters& parameters, const PrimitiveLibrary& library, const ChainSnapshot& snapshot,
             const Goal& goal, Time start, const Motion& at_start_W, double yaw_W_rad, const Aside& aside = {},
             const Trajectory* in_force = nullptr);

  /// Indices are below it.
  [[nodiscard]] std::uint32_t count() const { return in_force_ != nullptr ? kMostCandidates : kCandidateCount; }

  [[nodiscard]] const Objective& objective() const { return objective_; }

  /// That the candidate ramps to [m/s^2, L]; a brake's is zero, which it ends with.
  [[nodiscard]] Vec3 acceleration_L(std::uint32_t index) const;

  [[nodiscard]] Trajectory motion(std::uint32_t index) const;

  /// The brake that is verified with the candidate; a brake's is itself.
  [[nodiscard]] Trajectory brake(std::uint32_t index) const;

  [[nodiscard]] Proposal propose(std::uint32_t index) const;

  /// All of the candidate's brake, whatever its motion is worth.
  [[nodiscard]] TrajectoryRisk assessBrake(std::uint32_t index) const;

  /// By the views that answer. What is feasible so far may lead past something that others know of: lookBeside().
  /// @param stop_early  leave the risk of what is vetoed unfinished
  /// @param evidence    filled if given
  [[nodiscard]] Verdict judge(std::uint32_t index, bool stop_early, Evidence* evidence = nullptr) const;

  /// Adds what lies beside the views that answered, and what newer ones have measured, to judge()'s verdict and
  /// evidence, unless it is a veto. Only raises risks: what is not worth choosing needs no second look.
  void lookBeside(std::uint32_t index, bool stop_early, Verdict& verdict, Evidence* evidence = nullptr) const;

 private:
  [[nodiscard]] Trajectory brakeOf(std::uint32_t index, const Trajectory& motion) const;

  const PlannerParameters& parameters_;
  const PrimitiveLibrary& library_;
  SpaceAhead space_;
  Goal goal_;
  Objective objective_;
  Time start_;
  Motion at_start_W_;
  const Trajectory* in_force_;
  SampleEvidence start_evidence_;  ///< shared: all candidates, and all brakes, begin there
  Mat3 R_W_L_;
};

}  // namespace nanomap
