#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nanomap {

/// The command line of nanomap-flight.
struct FlightArguments {
  std::string config;
  std::vector<std::string> overrides;
  std::string log;     ///< empty: messages come from the network
  std::string record;  ///< directory; empty: nothing is recorded
  bool allow_no_realtime = false;
  bool check = false;
};

void declare(CLI::App& app, FlightArguments& arguments);

}  // namespace nanomap
