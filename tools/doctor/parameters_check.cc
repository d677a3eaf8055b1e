#include <fmt/format.h>

#include <string>

#include "tools/doctor/checks.h"
#include "tools/doctor/parameters.h"

namespace nanomap::doctor {
namespace {

std::vector<Parameter> wantedOf(AutopilotKind kind) {
  if (kind == AutopilotKind::kPx4) return px4Parameters();
  if (kind == AutopilotKind::kArduPilot) return arduPilotParameters();
  return {};
}

Finding judge(const Parameter& parameter, const Facts& facts) {
  const auto& values = facts.autopilot->parameters;
  const auto value = values.find(parameter.name);
  if (value == values.end() || !value->second) {
    return notLookedAt(parameter.name, "the autopilot did not tell it: look there by hand");
  }
  const std::string seen = fmt::format("{:g}", *value->second);
  const auto fault = parameter.judge(*value->second, facts);
  if (!fault) return ok(parameter.name, seen);
  return {fault->verdict, parameter.name, fmt::format("{}: {}", seen, fault->why),
          fmt::format("set {} = {} in the autopilot", parameter.name, fault->set)};
}

}  // namespace

std::vector<std::string> parametersOf(AutopilotKind kind) {
  std::vector<std::string> names;
  for (const Parameter& parameter : wantedOf(kind)) names.push_back(parameter.name);
  return names;
}

Findings checkParameters(const Facts& facts) {
  Findings findings;
  for (const Parameter& parameter : wantedOf(facts.autopilot->state.kind)) findings.push_back(judge(parameter, facts));
  return findings;
}

}  // namespace nanomap::doctor
