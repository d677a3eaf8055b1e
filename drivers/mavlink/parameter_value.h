#pragma once

#include <optional>

#include "drivers/mavlink/autopilot_messages.h"
#include "drivers/mavlink/autopilot_state.h"

namespace nanomap {

/// The number that a parameter has. PARAM_VALUE has room for a float only: PX4 puts the bytes of an integer into it,
/// ArduPilot the nearest float. Empty for a type that neither uses, or a value that is not finite.
[[nodiscard]] std::optional<double> numberOf(const ParameterMessage& message, AutopilotKind kind);

}  // namespace nanomap
