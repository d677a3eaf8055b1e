#pragma once

#include <string>

#include "firmware_app/configuration/configuration.h"
#include "tools/replay/replay.h"

namespace nanomap {

/// The report as text for a terminal: what went in, what became of it, what was answered, how long it took, and what
/// to mend. Reasons that never occurred are left out.
[[nodiscard]] std::string summaryOf(const ReplayReport& report, const Configuration& configuration);

}  // namespace nanomap
