#pragma once

#include <cstdint>
#include <optional>

#include "core/decision.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

/// The decision that is flown, and where its world is in the autopilot's. A decision is only taken over when that is
/// known, and not while the vehicle is braked: what is flown then is the brake that was verified before. So the
/// setpoint never steps with the estimator: after a jump of its world, the motion from before is flown where it was.
/// Threads: one. Allocates: no.
class MotionInForce {
 public:
  /// Goes over to the last decision that may be flown (isFlyable), if there was one and its world's place is known.
  /// @param sequence  the planner's count of it
  void adopt(const std::optional<Decision>& newest, std::uint64_t sequence, const Alignment& alignment);

  /// Keeps up with what is known of the world that the decision in force is of.
  void follow(const Alignment& alignment);

  [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }

  /// T_NED_W of the decision's world. @pre there is a decision
  [[nodiscard]] const NedFromWorld& anchor() const { return anchor_; }

  /// The anchor is of before, and still holds: the estimator has jumped since, and the poses' world is another; or the
  /// autopilot no longer tells where it is. It does not once the two have told of different motions: then it is the
  /// autopilot's own world that may have moved.
  [[nodiscard]] bool anchorOutlives(const Alignment& alignment) const;

 private:
  std::optional<Decision> decision_;
  std::uint64_t sequence_ = 0;
  NedFromWorld anchor_;
  bool contradicted_ = false;  ///< the anchor, by an alignment since
};

}  // namespace nanomap
