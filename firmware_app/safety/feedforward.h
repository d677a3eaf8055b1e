#pragma once

#include <chrono>

#include "core/time.h"
#include "core/trajectory.h"

namespace nanomap {

/// What a vehicle that follows its setpoints is behind them by, so that they are told earlier. The defaults are the
/// simulated vehicle's (tools/simulation/multicopter.h). Tilt and drag oppose each other in a brake: a share of both is
/// better than neither, one alone may be worse. Upwards a vehicle does not tilt first, and the lag is too long: it is
/// up to 3 cm off there, 2 cm without any of this.
struct Feedforward {
  Duration setpoint_lead = std::chrono::milliseconds(15);  ///< from sending one to when it is acted on, in the mean
  Duration tilt_lag = std::chrono::milliseconds(80);  ///< from then until the vehicle accelerates so: it tilts first
  double drag_1_s = 0.1;                              ///< deceleration per speed that no autopilot's model holds

  /// What is told at `now`, in the frame of the trajectory, so that the vehicle is on that.
  [[nodiscard]] Motion sample(const Trajectory& trajectory, Time now) const {
    const Time acted_on = now + setpoint_lead;
    Motion motion = trajectory.sample(acted_on);
    motion.acceleration_m_s2 =
        trajectory.sample(acted_on + tilt_lag).acceleration_m_s2 + drag_1_s * motion.velocity_m_s;
    return motion;
  }
};

}  // namespace nanomap
