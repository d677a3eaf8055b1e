#pragma once

#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/doctor/heard.h"

namespace nanomap::doctor {

/// @throws LogError if the log cannot be read
[[nodiscard]] Heard hearLog(LogReader& log, const LcmParameters& lcm);

}  // namespace nanomap::doctor
