#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <sstream>
#include <string>

#include "firmware_app/configuration/load.h"
#include "tools/doctor/arguments.h"
#include "tools/doctor/diagnosis.h"
#include "tools/doctor/gather_live.h"
#include "tools/doctor/gather_log.h"
#include "tools/doctor/gather_machine.h"
#include "tools/replay/log_files.h"
#include "tools/replay/recorded_configuration.h"

namespace nanomap::doctor {
namespace {

Facts gatherFromLog(const Arguments& arguments) {
  LogReader log(logFiles(arguments.logs));
  Facts facts;
  auto [configuration, origin] = chooseConfiguration(log, arguments.config, arguments.overrides);
  facts.configuration = std::move(configuration);
  facts.configuration_origin = std::move(origin);
  facts.heard = hearLog(log, facts.configuration.lcm);
  return facts;
}

Facts gatherHere(const Arguments& arguments) {
  Facts facts;
  facts.configuration = loadConfiguration(arguments.config, arguments.overrides);
  facts.configuration_origin = arguments.config.empty() ? "defaults" : arguments.config;
  fmt::print("listening for {:g} s to {} and {}\n", arguments.listen_s, facts.configuration.lcm.url,
             facts.configuration.mavlink.link.url);
  facts.machine = gatherMachine(facts.configuration, arguments.record);
  gatherLive(facts, static_cast<std::uint8_t>(arguments.component_id), fromSeconds(arguments.listen_s));
  return facts;
}

/// Each fault of the configuration, which names the key and what to write.
Findings refusalsOf(const ConfigurationError& error) {
  Findings findings;
  std::istringstream lines(error.what());
  for (std::string line; std::getline(lines, line);) {
    findings.push_back(failure("configuration", line, "mend it; 'nanomap-replay --help-config' explains every key"));
  }
  findings.push_back(notLookedAt("all else", "it depends on the configuration"));
  return findings;
}

Findings examine(const Arguments& arguments) {
  try {
    return diagnose(arguments.logs.empty() ? gatherHere(arguments) : gatherFromLog(arguments));
  } catch (const ConfigurationError& error) {
    return refusalsOf(error);
  }
}

}  // namespace
}  // namespace nanomap::doctor

int main(int argc, char** argv) {
  CLI::App app(
      "Says what keeps a vehicle from flying, and what to do about it: configuration, clocks, camera, network, "
      "machine\n"
      "and autopilot, live or from a log. It sends no setpoint, never arms and sets no parameter. Exit code 0 if "
      "nothing\n"
      "has failed.",
      "nanomap-doctor");
  nanomap::doctor::Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    const nanomap::doctor::Findings findings = nanomap::doctor::examine(arguments);
    fmt::print("{}", toText(findings));
    return anyFailure(findings) ? 1 : 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-doctor: {}\n", error.what());
    return 1;
  }
}
