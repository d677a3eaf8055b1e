#pragma once

#include <optional>

#include "core/decision.h"
#include "core/goal.h"

namespace nanomap {

/// The memory of having arrived. A goal that is corrected for drift moves by centimetres under a vehicle that stands at
/// it; without a memory it leaves and arrives again and again at the edge of the tolerance. One that has arrived stays
/// where it stands until the goal is farther off than that by half.
/// A function of what it was given, in that order. Allocates: no. Threads: one.
class Arrival {
 public:
  /// @param tolerance_m  within which a standstill is at the goal
  explicit Arrival(double tolerance_m) : tolerance_m_(tolerance_m) {}

  /// The goal to steer for: `goal`, or the place where the vehicle has arrived at it. @pre the goal is finite
  [[nodiscard]] Goal steer(const Goal& goal);

  /// What a plan for that goal came to.
  void note(const Decision& decision);

 private:
  struct Place {
    Vec3 position_W_m = Vec3::Zero();
    std::uint32_t epoch = 0;
  };

  double tolerance_m_;
  std::optional<Place> arrived_;
};

}  // namespace nanomap
