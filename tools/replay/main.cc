#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware_app/configuration/document.h"
#include "firmware_app/configuration/load.h"
#include "tools/replay/arguments.h"
#include "tools/replay/decision_diff.h"
#include "tools/replay/decision_log.h"
#include "tools/replay/log_files.h"
#include "tools/replay/recorded_configuration.h"
#include "tools/replay/summary.h"
#include "tools/replay/warnings.h"
#include "tools/replay/why.h"

namespace {

constexpr int kFailed = 1;
constexpr int kNotCompared = 2;  ///< as diff(1) has it: 1 is a difference

void runReplay(const nanomap::ReplayArguments& arguments, const nanomap::Configuration& configuration,
               nanomap::LogReader& log) {
  std::optional<nanomap::LogWriter> answers;
  std::optional<nanomap::LogWriter> decisions;
  if (!arguments.out.empty()) answers.emplace(arguments.out);
  if (!arguments.decisions.empty()) decisions.emplace(arguments.decisions);
  const nanomap::ReplayReport report =
      nanomap::replay(log, configuration, optionsFrom(arguments),
                      {.answers = answers ? &*answers : nullptr, .decisions = decisions ? &*decisions : nullptr});
  if (answers) answers->close();
  if (decisions) decisions->close();
  fmt::print("{}", nanomap::summaryOf(report, configuration));
  if (!report.has_camera) throw std::runtime_error(nanomap::explainMissingCamera(report, configuration));
}

int runDiff(const nanomap::ReplayArguments& arguments) {
  const auto decisions = [&](std::size_t i) { return nanomap::readDecisions(nanomap::logFiles({arguments.diff[i]})); };
  const auto diff = nanomap::compareDecisions(decisions(0), decisions(1));
  fmt::print("{}", toText(diff));
  return diff.same() ? 0 : 1;
}

void runOnLog(const nanomap::ReplayArguments& arguments) {
  const std::vector<std::filesystem::path> files = nanomap::logFiles(arguments.logs);
  checkOutputs(arguments, files);
  nanomap::LogReader log(files);
  const auto [configuration, origin] = nanomap::chooseConfiguration(log, arguments.config, arguments.overrides);
  fmt::print("configuration: {}\n", origin);
  if (arguments.why_s) {
    const nanomap::WhyQuestion question{nanomap::fromSeconds(*arguments.why_s), arguments.candidate};
    fmt::print("{}", nanomap::why(log, configuration, optionsFrom(arguments), question));
  } else {
    runReplay(arguments, configuration, log);
  }
}

/// @return the exit code
int run(const nanomap::ReplayArguments& arguments) {
  if (arguments.help_config) {
    fmt::print("{}", nanomap::annotatedToml({}));
    return 0;
  }
  if (!arguments.diff.empty()) return runDiff(arguments);
  if (arguments.check_config) {
    fmt::print("{}", nanomap::annotatedToml(nanomap::loadConfiguration(arguments.config, arguments.overrides)));
    return 0;
  }
  if (arguments.logs.empty()) throw std::runtime_error("no log given: nanomap-replay LOG (--help lists the options)");
  runOnLog(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Runs NanoMap and its planner over a recorded flight: answers about the space ahead of every frame, what the\n"
      "planner would have decided, and a summary.",
      "nanomap-replay");
  nanomap::ReplayArguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-replay: {}\n", error.what());
    return arguments.diff.empty() ? kFailed : kNotCompared;
  }
}
