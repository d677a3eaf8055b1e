#pragma once

#include <cstdint>
#include <optional>

#include "core/decision.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

/// The decision that is flown, and where its world is in the autopilot's. A decision is only taken over when that is
/// known: after a jump of the estimator's world, the one from before is flown on, where it was, until the new world's
/// place is known too. So the setpoint never steps with the estimator.
/// Threads: one. Allocates: no.
class MotionInForce {
 public:
  /// @param newest     the last decision that may be flown (isFlyable), if there was one
  /// @param sequence   the planner's count of it
  /// @param alignment  at this moment
  void update(const std::optional<Decision>& newest, std::uint64_t sequence, const Alignment& alignment);

  [[nodiscard]] const std::optional<Decision>& decision() const { return decision_; }
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }

  /// T_NED_W of the decision's world. @pre there is a decision
  [[nodiscard]] const NedFromWorld& anchor() const { return anchor_; }

 private:
  std::optional<Decision> decision_;
  std::uint64_t sequence_ = 0;
  NedFromWorld anchor_;
};

}  // namespace nanomap
