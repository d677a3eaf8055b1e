#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/generate/sensed_flight.h"
#include "tools/sim/lockstep_flyer.h"
#include "tools/sim/sensor_fault_plan.h"

namespace nanomap::sim {

struct LockstepFlight {
  std::uint64_t seed = 0;
  generate::SensedFlightSummary sensed;
  LockstepSummary flown;

  /// From departure to end.
  [[nodiscard]] double flown_s() const;
  [[nodiscard]] double meanSpeed_m_s() const;
};

/// Flies a simulated multicopter through `flight`'s scene (LockstepFlyer) until it stands at the goal, has collided, or
/// `duration` is over.
/// @param recordings  folder; empty: nothing is recorded
/// @throws as LockstepFlyer's constructor
[[nodiscard]] LockstepFlight flyInLockstep(const Configuration& configuration, const generate::SensedFlight& flight,
                                           Duration duration, const SensorFaultPlanParameters& faults = {},
                                           const std::optional<std::filesystem::path>& recordings = std::nullopt);

/// One line a flight, with a head, and what they come to.
[[nodiscard]] std::string tableOf(const std::string& scene, const std::vector<LockstepFlight>& flights);

}  // namespace nanomap::sim
