#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/generate/sensed_flight.h"
#include "tools/sim/live_flight.h"
#include "tools/sim/sensor_fault_plan.h"

namespace nanomap::sim {

/// The command line, in its own units.
struct Arguments {
  std::optional<std::filesystem::path> recordings;
  std::uint64_t flights = 1;
  bool blind = false;
  std::string config;
  std::vector<std::string> overrides;
  generate::SensedFlightOptions options;
  double duration_s = 120.0;
  double drift_5s_m = 0.2;
  bool raw = false;
  std::string camera_off;
  std::string vio_off;
  std::string vio_jump;
  std::vector<std::string> message_faults;

  bool live = false;
  std::optional<std::filesystem::path> log;
  std::string autopilot_url = LiveFlightOptions().autopilot_url;
  std::optional<double> heading_deg;
};

void addOptions(CLI::App& app, Arguments& arguments);

[[nodiscard]] generate::SensedFlightOptions sensedFlightOf(const Arguments& arguments);

/// @throws std::invalid_argument naming the option and what it was given
[[nodiscard]] SensorFaultPlanParameters faultsOf(const Arguments& arguments);

/// Likewise.
[[nodiscard]] std::vector<PlannedMessageFault> messageFaultsOf(const Arguments& arguments);

}  // namespace nanomap::sim
