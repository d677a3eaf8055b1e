#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nanomap::doctor {

/// The command line of nanomap-doctor.
struct Arguments {
  std::vector<std::string> logs;  ///< empty: it listens to the network
  std::string config;
  std::vector<std::string> overrides;
  std::string record;     ///< where flights are to be recorded; empty: not told
  double listen_s = 5.0;  ///< enough for heartbeats, parameters and a clock's lag
  /// Ours in MAVLink, MAV_COMP_ID_ONBOARD_COMPUTER4: an autopilot must not take us for the flight process.
  int component_id = 194;
};

void declare(CLI::App& app, Arguments& arguments);

}  // namespace nanomap::doctor
