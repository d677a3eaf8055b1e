#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

/// The settings of autopilots that a flight depends on, and what they must be.
namespace nanomap::doctor {

/// What is wrong with one value.
struct ParameterFault {
  Verdict verdict = Verdict::kFailure;
  std::string why;
  std::string set;  ///< what to set it to
};

struct Parameter {
  using Judge = std::function<std::optional<ParameterFault>(double value, const Facts& facts)>;

  std::string name;
  Judge judge;  ///< of the value that the autopilot tells; empty: nothing is wrong
};

[[nodiscard]] std::vector<Parameter> px4Parameters();
[[nodiscard]] std::vector<Parameter> arduPilotParameters();

/// Of both: for how long an autopilot flies on without setpoints, in seconds.
[[nodiscard]] std::optional<ParameterFault> judgeLoss(double value_s, const Facts& facts);

}  // namespace nanomap::doctor
