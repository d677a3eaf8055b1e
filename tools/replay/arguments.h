#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/replay/replay.h"

namespace nanomap {

/// What nanomap-replay is told on its command line.
struct ReplayArguments {
  std::vector<std::string> logs;
  std::string out;
  std::string decisions;
  std::string config;
  std::vector<std::string> overrides;
  double from_s = 0.0;
  std::optional<double> to_s;
  std::optional<double> rate;
  std::vector<double> goal_W_m;  ///< x, y, z; empty: the log's
  double goal_speed_m_s = 4.0;   ///< the authors' typical soft top speed
  std::optional<double> why_s;
  std::optional<std::uint32_t> candidate;
  std::vector<std::string> diff;  ///< two logs; empty: none
  bool check_config = false;
  bool help_config = false;
};

void declare(CLI::App& app, ReplayArguments& arguments);

/// @throws std::runtime_error naming the option that is out of its range
[[nodiscard]] ReplayOptions optionsFrom(const ReplayArguments& arguments);

/// @param logs  to be read
/// @throws std::runtime_error if a log to be written is one of those, or the other one
void checkOutputs(const ReplayArguments& arguments, const std::vector<std::filesystem::path>& logs);

}  // namespace nanomap
