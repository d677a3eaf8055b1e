#pragma once

#include <string>
#include <vector>

#include "firmware_app/configuration/configuration.h"
#include "tools/replay/replay.h"

namespace nanomap {

/// What a person should know or mend after a replay, one sentence each: what is missing or wrong, and what to do.
[[nodiscard]] std::vector<std::string> warningsOf(const ReplayReport& report, const Configuration& configuration);

/// Why there is no camera, for a replay that ended without one. @pre !report.has_camera
[[nodiscard]] std::string explainMissingCamera(const ReplayReport& report, const Configuration& configuration);

}  // namespace nanomap
