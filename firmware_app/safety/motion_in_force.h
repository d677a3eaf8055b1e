#pragma once

#include <cstdint>
#include <optional>

#include "core/decision.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

/// Whose poses the autopilot flies by.
enum class AutopilotWorld : std::uint8_t {
  kItsOwn,  ///< its world stays where it is when ours jumps
  kOurs,    ///< it gets our poses (ODOMETRY): when ours jumps, its world does, by as much
};

/// The decision that is flown, and where its world is in the autopilot's. A decision is only taken over when that is
/// known, and not while the vehicle is braked: what is flown then is the brake that was verified before. So the
/// setpoint never steps with the estimator: after a jump of its world, the motion from before is flown where it was.
/// Threads: one. Allocates: no.
class MotionInForce {
 public:
  explicit MotionInForce(AutopilotWorld autopilot_world) : autopilot_world_(autopilot_world) {}

  /// Goes over to the last decision that may be flown (isFlyable), if there was one and its world's place is known.
  /// @param sequence  the planner's count of it
  void adopt(const std::optional<Decision>& newest, std::uint64_t sequence, const Alignment& alignment);

  /// Keeps up with what is known of the world that the decision in force is of.
  void follow(const Alignment& alignment);

  [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }

  /// T_NED_W of the decision's world. @pre there is a decision
  [[nodiscard]] const NedFromWorld& anchor() const { return anchor_; }

  /// Is the decision's world where the anchor says? It is known to be, or was known before and nothing since tells
  /// otherwise: the autopilot no longer tells where it is; or the estimator has jumped, and the autopilot has a world
  /// of its own. Not once the two have told of different motions: then it is the autopilot's world that may have moved.
  /// @param poses_epoch  of the estimator's world now
  [[nodiscard]] bool anchorHolds(const Alignment& alignment, std::uint32_t poses_epoch) const;

 private:
  AutopilotWorld autopilot_world_;
  std::optional<Decision> decision_;
  std::uint64_t sequence_ = 0;
  NedFromWorld anchor_;
  bool contradicted_ = false;  ///< the anchor, by an alignment since
};

}  // namespace nanomap
