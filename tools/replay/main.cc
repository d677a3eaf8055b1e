#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "firmware_app/configuration/document.h"
#include "firmware_app/configuration/load.h"
#include "tools/replay/replay.h"
#include "tools/replay/summary.h"
#include "tools/replay/warnings.h"

namespace {

/// Thirty years: what lies behind is a slip of the pen, and its nanoseconds still fit.
constexpr double kLongestLog_s = 1e9;
constexpr double kMinRate = 1e-3;
constexpr double kMaxRate = 1e6;

struct Arguments {
  std::string log;
  std::string out;
  std::string config;
  std::vector<std::string> overrides;
  double from_s = 0.0;
  std::optional<double> to_s;
  std::optional<double> rate;
  bool check_config = false;
  bool help_config = false;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("LOG", arguments.log, "LCM log of depth frames, poses and corrections");
  app.add_option("--out", arguments.out, "LCM log of answers to write");
  app.add_option("--config", arguments.config, "configuration file (TOML); without it, defaults");
  app.add_option("--set", arguments.overrides, "section.key=value: wins over the file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--rate", arguments.rate, "times real time; without it, as fast as it goes");
  app.add_option("--from", arguments.from_s, "start this many seconds into the log");
  app.add_option("--to", arguments.to_s, "end this many seconds into the log");
  app.add_flag("--check-config", arguments.check_config, "check the configuration, print what holds, and end");
  app.add_flag("--help-config", arguments.help_config, "print the default configuration with every key explained");
}

void require(bool condition, const std::string& message) {
  if (!condition) throw std::runtime_error(message);
}

/// NaN is in no range.
void requireInRange(const std::string& option, double value, double min, double max) {
  require(value >= min && value <= max, fmt::format("{} {}: must be in {} .. {}", option, value, min, max));
}

nanomap::ReplayOptions optionsFrom(const Arguments& arguments) {
  requireInRange("--from", arguments.from_s, 0.0, kLongestLog_s);
  requireInRange("--to", arguments.to_s.value_or(kLongestLog_s), 0.0, kLongestLog_s);
  requireInRange("--rate", arguments.rate.value_or(1.0), kMinRate, kMaxRate);
  require(!arguments.to_s || *arguments.to_s >= arguments.from_s, "--to must not be before --from");
  nanomap::ReplayOptions options;
  options.from = nanomap::fromSeconds(arguments.from_s);
  if (arguments.to_s) options.to = nanomap::fromSeconds(*arguments.to_s);
  options.rate = arguments.rate;
  return options;
}

void run(const Arguments& arguments) {
  if (arguments.help_config) {
    fmt::print("{}", nanomap::annotatedToml({}));
    return;
  }
  const nanomap::Configuration configuration = nanomap::loadConfiguration(arguments.config, arguments.overrides);
  if (arguments.check_config) {
    fmt::print("{}", nanomap::annotatedToml(configuration));
    return;
  }
  require(!arguments.log.empty(), "no log given: nanomap-replay LOG (--help lists the options)");

  std::error_code no_such_file;
  require(!std::filesystem::equivalent(arguments.log, arguments.out, no_such_file),
          "--out " + arguments.out + " is the log itself: name another file");

  nanomap::LogReader log(arguments.log);
  std::optional<nanomap::LogWriter> answers;
  if (!arguments.out.empty()) answers.emplace(arguments.out);
  const nanomap::ReplayReport report =
      nanomap::replay(log, configuration, optionsFrom(arguments), answers ? &*answers : nullptr);
  if (answers) answers->close();
  fmt::print("{}", nanomap::summaryOf(report, configuration));
  require(report.has_camera, nanomap::explainMissingCamera(report, configuration));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs NanoMap over a recorded flight: answers about the space ahead of every frame, and a summary.",
               "nanomap-replay");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    run(arguments);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-replay: {}\n", error.what());
    return 1;
  }
}
