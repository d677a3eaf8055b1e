#pragma once

#include <string>

#include "firmware_app/stages/sink_stage.h"
#include "nanomap/setpoint_t.hpp"

namespace nanomap {

/// @pre something was sent
[[nodiscard]] setpoint_t toMessage(const SentSetpoint& setpoint);

/// The state in words, with what is wrong or missing: "waiting: depth images, a plan".
[[nodiscard]] std::string stateInWords(const SafetyVerdict& verdict);

}  // namespace nanomap
