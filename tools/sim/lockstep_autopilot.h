#pragma once

#include <cstdint>
#include <optional>

#include "core/trajectory.h"
#include "drivers/mavlink/ned_from_world.h"
#include "tools/sim/in_process_autopilot.h"
#include "tools/simulation/multicopter.h"
#include "tools/simulation/position_controller.h"

namespace nanomap::sim {

/// PX4's part in a flight on a simulated clock: a multicopter, the cascade that flies it by an estimate of its own (the
/// truth, in an arbitrary NED), and a stream of setpoints that it lets go of for HOLD when it ends (COM_OF_LOSS_T).
/// Threads: one.
class LockstepAutopilot : public InProcessAutopilot {
 public:
  /// Hovers, armed, in the pilot's hands.
  /// @param position_W_m, yaw_W_rad  in the scene's world
  LockstepAutopilot(const simulation::MulticopterParameters& vehicle, const Vec3& position_W_m, double yaw_W_rad,
                    Time start);

  /// Flies on to `until`. @pre not before the time of the last call
  void advance(Time until);

  /// The truth, in the scene's world, at the time of the last advance.
  [[nodiscard]] simulation::VehicleState vehicle() const { return vehicle_.state(); }

  /// How often the stream ended while the vehicle was in our hands.
  [[nodiscard]] std::uint64_t failsafes() const { return failsafes_; }

 private:
  void moveTo(Time time);
  void control();
  [[nodiscard]] Motion setpoint(const Motion& own_W);
  void tellPose();

  simulation::Multicopter vehicle_;
  simulation::PositionController controller_;
  simulation::MulticopterCommand command_;
  Time next_control_;
  std::optional<Vec3> hold_W_m_;  ///< where it stays without setpoints, once it has come to rest
  std::uint64_t failsafes_ = 0;
};

}  // namespace nanomap::sim
