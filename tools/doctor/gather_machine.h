#pragma once

#include <string>

#include "firmware_app/configuration/configuration.h"
#include "tools/doctor/facts.h"

namespace nanomap::doctor {

/// Asks the kernel; tries SCHED_FIFO on a thread of its own, which does nothing else.
/// @param record  folder that flights are to be recorded in; empty: not asked
[[nodiscard]] MachineFacts gatherMachine(const Configuration& configuration, const std::string& record);

/// net.core.rmem_max; empty where /proc is missing.
[[nodiscard]] std::optional<int> receiveBufferLimit();

}  // namespace nanomap::doctor
