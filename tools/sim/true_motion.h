#pragma once

#include <cstdint>

#include "core/ring_buffer.h"
#include "core/time.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/ned_from_world.h"
#include "tools/simulation/vehicle_state.h"

namespace nanomap::sim {

/// How far an extrapolation to the moment of the next pose was from that pose.
struct ExtrapolationError {
  std::uint64_t count = 0;
  double square_sum_m2 = 0.0;
  double worst_m = 0.0;
  double square_sum_rad2 = 0.0;
  double worst_rad = 0.0;
};

/// The true motion of a vehicle in a scene, at any moment, from the poses that its autopilot tells now and then: the
/// last one before the moment, continued with constant acceleration and turn rate. Threads: one.
class TrueMotion {
 public:
  explicit TrueMotion(const NedFromWorld& T_NED_W);

  /// One that is not later than the newest is passed over.
  void add(const AutopilotPose& pose);

  /// @pre a pose was added
  [[nodiscard]] Time newest() const { return poses_.back().stamp; }
  /// @pre a pose was added
  [[nodiscard]] simulation::VehicleState at(Time stamp) const;

  /// Of all poses that came no later than half a second after the one before.
  [[nodiscard]] const ExtrapolationError& error() const { return error_; }

 private:
  struct Sample {
    Time stamp{};
    simulation::VehicleState state;
  };

  [[nodiscard]] Vec3 meanAcceleration(Time stamp, const Vec3& velocity_W_m_s) const;

  NedFromWorld T_NED_W_;
  RingBuffer<Sample> poses_;  ///< in W
  ExtrapolationError error_;
};

}  // namespace nanomap::sim
