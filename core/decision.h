#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/status.h"
#include "core/time.h"
#include "core/trajectory.h"

namespace nanomap {

/// Why the planner decided as it did.
enum class Reason : std::uint8_t {
  kFlying,           ///< towards the goal
  kGoingRound,       ///< round what is in the way, at first not towards the goal
  kKeeping,          ///< nothing new is better than what is left of the motion in force and its brake: that is flown on
  kAtGoal,           ///< stops at the goal
  kSlowing,          ///< faster than the top speed: the goal's, the vehicle's, or a detour's
  kTurning,          ///< stands, and turns towards a goal that is out of view
  kBlocked,          ///< nothing that leads nearer to the goal is safe; looks around
  kRetreating,       ///< too near to something, where not even stopping is safe: moves away from it, or stops at once
  kNothingVerified,  ///< not even stopping is safe, where it leads was not seen: the last verified brake stays in force
  kNoGoal,           ///< none given yet
  kGoalInvalid,      ///< not finite, beyond all reason, or without a positive top speed
  kGoalOtherEpoch,   ///< given in a world that the estimator has left
  kNoView,           ///< no depth image in the chain
  kStateInvalid,     ///< not finite, no unit quaternion, or beyond all reason
  kStateOtherTime,   ///< too old, or ahead of the time planned for
  kStateOtherEpoch,  ///< of another world than the snapshot
};
inline constexpr std::size_t kReasonCount = 16;

/// In a pilot's words.
[[nodiscard]] std::string_view toString(Reason reason);

/// Candidates that were refused, by what weighed most in the sample at which the risk went over the constraint.
struct VetoCounts {
  std::array<std::uint32_t, kStatusCount> by_status{};
  std::uint32_t by_neighbours = 0;  ///< measured points too near
  std::uint32_t of_brakes = 0;      ///< of all those: the motion itself was safe, its brake was not

  bool operator==(const VetoCounts&) const = default;
};

/// The inputs, by the sequence numbers of those who sent them.
struct Consumed {
  std::uint32_t epoch = 0;
  std::uint64_t state_sequence = 0;
  std::uint64_t pose_sequence = 0;  ///< of the snapshot
  std::optional<std::uint64_t> correction_sequence;
  std::optional<std::uint64_t> newest_view_sequence;
  std::uint32_t view_count = 0;
  std::optional<std::uint64_t> goal_sequence;
};

/// What the planner chose, why, and from what. Holds no measured time.
struct Decision {
  Time stamp{};  ///< the time planned for, at which the trajectories start
  Consumed consumed;
  Reason reason = Reason::kStateInvalid;

  /// Chosen candidate (planner/primitive_library.h); empty if the state allowed none, and then there is no motion
  /// below.
  std::optional<std::uint32_t> candidate;
  Trajectory trajectory;
  double risk = 1.0;  ///< collision probability of the trajectory

  /// The contingency: the trajectory at first, then braking to a standstill. What may be flown of a decision is for
  /// isFlyable() to say (planner/receding_horizon.h): a retreat is flown without being within the constraint.
  Trajectory brake;
  bool brake_verified = false;
  double brake_risk = 1.0;  ///< of a verified brake; else 1: nothing is known

  double yaw_W_rad = 0.0;  ///< heading to be turned to
  double yaw_rate_rad_s = 0.0;

  std::uint32_t candidates = 0;  ///< considered
  std::uint32_t evaluated = 0;   ///< by queries; the others could not have been chosen
  std::uint32_t feasible = 0;    ///< of the evaluated, as far as asked: what would not be chosen gets no second look
  VetoCounts vetoes;             ///< of the evaluated
};

}  // namespace nanomap
