#include <fmt/format.h>

#include <cmath>

#include "tools/doctor/parameters.h"

namespace nanomap::doctor {
namespace {

std::optional<ParameterFault> judgeLossAction(double value, const Facts& /*facts*/) {
  constexpr long kLastOfThePilot = 2;  // position, altitude, manual
  constexpr long kReturn = 3;
  constexpr long kLand = 4;
  constexpr long kHold = 5;
  const std::string hold = fmt::format("{} (hold), or {} (land)", kHold, kLand);
  const long action = std::lround(value);
  if (action == kLand || action == kHold) return std::nullopt;
  if (action == kReturn) {
    return ParameterFault{Verdict::kWarning, "when the stream of setpoints ends, it returns, and sees no obstacles",
                          hold};
  }
  return ParameterFault{Verdict::kFailure,
                        action >= 0 && action <= kLastOfThePilot
                            ? "when the stream of setpoints ends, it is in the hands of a pilot at the sticks"
                            : "when the stream of setpoints ends, it falls, or does nothing",
                        hold};
}

std::optional<ParameterFault> judgeVisionControl(double value, const Facts& facts) {
  constexpr unsigned kHorizontalAndYaw = 1U | 8U;
  constexpr const char* kAll = "15 (position, height, velocity, yaw)";
  const auto bits = static_cast<unsigned>(std::lround(value));
  const bool sent = facts.configuration.mavlink.send_odometry;
  if (sent && bits == 0)
    return ParameterFault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not used", kAll};
  if (sent && (bits & kHorizontalAndYaw) != kHorizontalAndYaw) {
    return ParameterFault{Verdict::kWarning,
                          "of our poses (mavlink.send_odometry), horizontal position or yaw is not used", kAll};
  }
  if (!sent && bits != 0) {
    return ParameterFault{Verdict::kWarning,
                          "it waits for external vision that nobody here sends: mavlink.send_odometry = true, or", "0"};
  }
  return std::nullopt;
}

std::optional<ParameterFault> judgeVisionDelay(double value_ms, const Facts& facts) {
  constexpr double kMost_ms = 100.0;
  if (!facts.configuration.mavlink.send_odometry || value_ms <= kMost_ms) return std::nullopt;
  return ParameterFault{Verdict::kWarning, "our poses carry the time they are of: little is left to take off", "0"};
}

}  // namespace

std::vector<Parameter> px4Parameters() {
  return {{"COM_OF_LOSS_T", judgeLoss},
          {"COM_OBL_RC_ACT", judgeLossAction},
          {"EKF2_EV_CTRL", judgeVisionControl},
          {"EKF2_EV_DELAY", judgeVisionDelay}};
}

}  // namespace nanomap::doctor
