#pragma once

#include <cstdint>
#include <vector>

#include "core/time.h"
#include "tools/simulation/scene.h"
#include "tools/simulation/vehicle_state.h"

namespace nanomap::simulation {

struct FlightParameters {
  double cruise_speed_m_s = 7.0;
  double max_tilt_rad = 0.698;  ///< 40 degrees, as when the paper's vehicle brakes; bounds the horizontal acceleration
  double max_yaw_rate_rad_s = 1.5;  ///< slows tight turns down
  double min_clearance_m = 0.55;    ///< kept to every obstacle: vehicle radius and a margin
};

/// A smooth flight from a scene's start to its goal that someone could have flown: takes off into motion, cruises at
/// changing speeds, dodges what is in the way, brakes hard now and then, stops at the goal. The vehicle tilts as its
/// acceleration demands and looks where it flies. The seed draws the speeds.
/// Threads: immutable, any number of readers.
class FlightPath {
 public:
  /// @throws std::invalid_argument naming a parameter that is not positive, or if the goal is the start
  /// @throws std::runtime_error naming the scene if no way through keeps the clearance
  FlightPath(const Scene& scene, const FlightParameters& parameters, std::uint64_t seed);

  /// From the first motion to standstill.
  [[nodiscard]] Duration duration() const;

  /// State after `elapsed`; hovering before the start and after the end.
  [[nodiscard]] VehicleState at(Duration elapsed) const;

 private:
  std::vector<VehicleState> states_;  ///< at kSamplePeriod_s
};

}  // namespace nanomap::simulation
