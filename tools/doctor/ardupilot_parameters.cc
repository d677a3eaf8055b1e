#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/doctor/parameters.h"

// As ArduPilot's developers document it under "Non-GPS Position Estimation".
namespace nanomap::doctor {
namespace {

constexpr long kNone = 0;
constexpr long kBarometer = 1;
constexpr long kGps = 3;
constexpr long kExternalNavigation = 6;

constexpr const char* kHorizontalPosition = "EK3_SRC1_POSXY";
constexpr const char* kVisionType = "VISO_TYPE";

/// Takes poses as they come; the other types turn them to the autopilot's heading.
constexpr long kMavlinkVision = 1;
constexpr long kLastVision = 3;

bool isSent(const Facts& facts) { return facts.configuration.mavlink.send_odometry; }

/// Did the autopilot tell that value of that parameter?
bool has(const Facts& facts, const char* name, long value) {
  const auto& told = facts.autopilot->parameters;
  const auto found = told.find(name);
  return found != told.end() && found->second && std::lround(*found->second) == value;
}

/// Nobody here sends what it waits for.
std::optional<ParameterFault> judgeUnsent(double value, const std::string& usual) {
  if (std::lround(value) != kExternalNavigation) return std::nullopt;
  return ParameterFault{Verdict::kWarning,
                        "it waits for external navigation that nobody here sends: mavlink.send_odometry = true, or",
                        usual};
}

std::optional<ParameterFault> judgeHorizontalPosition(double value, const Facts& facts) {
  if (!isSent(facts)) return judgeUnsent(value, fmt::format("{} (GPS)", kGps));
  if (std::lround(value) == kExternalNavigation) return std::nullopt;
  return ParameterFault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not used",
                        fmt::format("{} (external navigation)", kExternalNavigation)};
}

/// One that may be of external navigation, or of something that does not contradict it.
Parameter::Judge judgeBeside(long harmless, std::string harmless_name, std::string usual) {
  return [=](double value, const Facts& facts) -> std::optional<ParameterFault> {
    if (!isSent(facts)) return judgeUnsent(value, usual);
    const long source = std::lround(value);
    if (source == kExternalNavigation || source == harmless) return std::nullopt;
    return ParameterFault{
        Verdict::kWarning, "our poses are sent (mavlink.send_odometry), and mixed with what it has else",
        fmt::format("{} (external navigation), or {} ({})", kExternalNavigation, harmless, harmless_name)};
  };
}

std::optional<ParameterFault> judgeYaw(double value, const Facts& facts) {
  if (!isSent(facts)) return judgeUnsent(value, "1 (compass)");
  const bool by_our_position = has(facts, kHorizontalPosition, kExternalNavigation);
  const bool turned = !has(facts, kVisionType, kMavlinkVision);
  if (std::lround(value) == kExternalNavigation || !by_our_position || turned) return std::nullopt;
  return ParameterFault{Verdict::kFailure,
                        fmt::format("it flies by our positions, whose axes are not turned to its heading ({} = {})",
                                    kVisionType, kMavlinkVision),
                        fmt::format("{} (external navigation)", kExternalNavigation)};
}

std::optional<ParameterFault> judgeVisionType(double value, const Facts& facts) {
  const long type = std::lround(value);
  if (!isSent(facts) || (type >= kMavlinkVision && type <= kLastVision)) return std::nullopt;
  return ParameterFault{Verdict::kFailure, "our poses are sent (mavlink.send_odometry), and not taken in",
                        fmt::format("{} (MAVLink)", kMavlinkVision)};
}

}  // namespace

std::vector<Parameter> arduPilotParameters() {
  return {{"GUID_TIMEOUT", judgeLoss},
          {kHorizontalPosition, judgeHorizontalPosition},
          {"EK3_SRC1_VELXY", judgeBeside(kNone, "none", fmt::format("{} (GPS)", kGps))},
          {"EK3_SRC1_POSZ", judgeBeside(kBarometer, "barometer", fmt::format("{} (barometer)", kBarometer))},
          {"EK3_SRC1_VELZ", judgeBeside(kNone, "none", fmt::format("{} (GPS)", kGps))},
          {"EK3_SRC1_YAW", judgeYaw},
          {kVisionType, judgeVisionType}};
}

}  // namespace nanomap::doctor
