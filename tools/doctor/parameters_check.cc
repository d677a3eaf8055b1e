#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

/// PX4 wants 2 Hz of setpoints; and a vehicle whose companion has died flies on by its last one for as long.
constexpr double kShortestLoss_s = 0.5;
constexpr double kLongestLoss_s = 1.5;
constexpr double kUsualLoss_s = 1.0;

/// What is wrong with one value.
struct Fault {
  Verdict verdict = Verdict::kFailure;
  std::string why;
  std::string set;  ///< what to set it to
};

using Judge = std::function<std::optional<Fault>(double value, const Facts& facts)>;

struct Parameter {
  std::string name;
  Judge judge;
};

std::optional<Fault> judgeLoss(double value_s, const Facts& facts) {
  const double speed_m_s = facts.configuration.planner.limits.full_speed_m_s;
  const std::string usual = fmt::format("{:g}", kUsualLoss_s);
  if (value_s < kShortestLoss_s) {
    return Fault{Verdict::kFailure, fmt::format("any hiccup of {:g} s ends external control in mid-flight", value_s),
                 usual};
  }
  if (value_s > kLongestLoss_s) {
    return Fault{Verdict::kFailure,
                 fmt::format("if this computer dies at {:g} m/s, it flies on for {:.0f} m before it acts", speed_m_s,
                             value_s * speed_m_s),
                 usual};
  }
  return std::nullopt;
}

std::optional<Fault> judgeLossAction(double value, const Facts& /*facts*/) {
  constexpr long kLastOfThePilot = 2;  // position, altitude, manual
  constexpr long kReturn = 3;
  constexpr long kLand = 4;
  constexpr long kHold = 5;
  const std::string hold = fmt::format("{} (hold), or {} (land)", kHold, kLand);
  const long action = std::lround(value);
  if (action == kLand || action == kHold) return std::nullopt;
  if (action == kReturn) {
    return Fault{Verdict::kWarning, "when the stream of setpoints ends, it returns, and sees no obstacles", hold};
  }
  return Fault{Verdict::kFailure,
               action >= 0 && action <= kLastOfThePilot
                   ? "when the stream of setpoints ends, it is in the hands of a pilot at the sticks"
                   : "when the stream of setpoints ends, it falls, or does nothing",
               hold};
}

std::optional<Fault> judgeVisionControl(double value, const Facts& facts) {
  constexpr unsigned kHorizontalAndYaw = 1U | 8U;
  constexpr const char* kAll = "15 (position, height, velocity, yaw)";
  const auto bits = static_cast<unsigned>(std::lround(value));
  const bool sent = facts.configuration.mavlink.send_odometry;
  if (sent && bits == 0)
    return Fault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not used", kAll};
  if (sent && (bits & kHorizontalAndYaw) != kHorizontalAndYaw) {
    return Fault{Verdict::kWarning, "of our poses (mavlink.send_odometry), horizontal position or yaw is not used",
                 kAll};
  }
  if (!sent && bits != 0) {
    return Fault{Verdict::kWarning,
                 "it waits for external vision that nobody here sends: mavlink.send_odometry = true, or", "0"};
  }
  return std::nullopt;
}

std::optional<Fault> judgeVisionDelay(double value_ms, const Facts& facts) {
  constexpr double kMost_ms = 100.0;
  if (!facts.configuration.mavlink.send_odometry || value_ms <= kMost_ms) return std::nullopt;
  return Fault{Verdict::kWarning, "our poses carry the time they are of: little is left to take off", "0"};
}

constexpr int kExternalNavigation = 6;

std::optional<Fault> judgeVisionSource(double value, const Facts& facts) {
  const bool used = std::lround(value) == kExternalNavigation;
  const bool sent = facts.configuration.mavlink.send_odometry;
  if (sent && !used) return Fault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not used", "6"};
  if (!sent && used) {
    return Fault{Verdict::kWarning,
                 "it waits for external navigation that nobody here sends: mavlink.send_odometry = true, or",
                 "3 (GPS)"};
  }
  return std::nullopt;
}

std::optional<Fault> judgeVisionType(double value, const Facts& facts) {
  constexpr long kMavlink = 1;
  if (!facts.configuration.mavlink.send_odometry || std::lround(value) == kMavlink) return std::nullopt;
  return Fault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not taken in", "1 (MAVLink)"};
}

std::vector<Parameter> wantedOf(AutopilotKind kind) {
  if (kind == AutopilotKind::kPx4) {
    return {{"COM_OF_LOSS_T", judgeLoss},
            {"COM_OBL_RC_ACT", judgeLossAction},
            {"EKF2_EV_CTRL", judgeVisionControl},
            {"EKF2_EV_DELAY", judgeVisionDelay}};
  }
  if (kind == AutopilotKind::kArduPilot) {
    return {{"GUID_TIMEOUT", judgeLoss}, {"EK3_SRC1_POSXY", judgeVisionSource}, {"VISO_TYPE", judgeVisionType}};
  }
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
