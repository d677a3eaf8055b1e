#include "tools/doctor/parameters.h"

#include <fmt/format.h>

namespace nanomap::doctor {

std::optional<ParameterFault> judgeLoss(double value_s, const Facts& facts) {
  // PX4 wants 2 Hz of setpoints; and a vehicle whose companion has died flies on by its last one for as long.
  constexpr double kShortestLoss_s = 0.5;
  constexpr double kLongestLoss_s = 1.5;
  constexpr double kUsualLoss_s = 1.0;
  const double speed_m_s = facts.configuration.planner.limits.full_speed_m_s;
  const std::string usual = fmt::format("{:g}", kUsualLoss_s);
  if (value_s < kShortestLoss_s) {
    return ParameterFault{Verdict::kFailure,
                          fmt::format("any hiccup of {:g} s ends external control in mid-flight", value_s), usual};
  }
  if (value_s > kLongestLoss_s) {
    return ParameterFault{Verdict::kFailure,
                          fmt::format("if this computer dies at {:g} m/s, it flies on for {:.0f} m before it acts",
                                      speed_m_s, value_s * speed_m_s),
                          usual};
  }
  return std::nullopt;
}

}  // namespace nanomap::doctor
