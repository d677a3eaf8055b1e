#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/generate/sensed_flight.h"
#include "tools/sim/live_flyer.h"
#include "tools/sim/sensor_fault_plan.h"

namespace nanomap::sim {

struct LiveFlightOptions {
  std::string autopilot_url = "udpin://0.0.0.0:14550";
  std::optional<double> heading_rad;  ///< of the way to the goal, clockwise from north; empty: the vehicle's at first
  double vehicle_radius_m = 0.0;      ///< of the sphere that holds the vehicle
  Duration duration{};                ///< to give up after
  SensorFaultPlanParameters faults;
  std::vector<PlannedMessageFault> message_faults;
  std::optional<std::filesystem::path> log;
};

struct LiveFlight {
  Time start{};  ///< of the sensors
  generate::SensedFlightSummary sensed;
  LiveFlightSummary flown;
};

/// Waits for an autopilot, lays the scene around its vehicle, and lets the sensors look while it flies.
/// @param tell     is told what happens, in words
/// @param stopped  by the user
/// @throws std::exception with a message that says what is missing
[[nodiscard]] LiveFlight flyLive(const Configuration& configuration, const generate::SensedFlight& flight,
                                 const LiveFlightOptions& options, const std::function<void(const std::string&)>& tell,
                                 const std::function<bool()>& stopped);

}  // namespace nanomap::sim
