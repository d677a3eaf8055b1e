#pragma once

#include <string>
#include <vector>

#include "firmware_app/configuration/configuration.h"
#include "firmware_app/realtime/thread_layout.h"

namespace nanomap {

/// What start-up has found out about the machine, and done about it.
struct Surroundings {
  ThreadLayout layout;
  std::vector<std::string> remarks;  ///< what someone should know, though it does not stop us
};

/// Checks what the machine grants, and locks the process's memory.
/// @param allow_no_realtime  what is refused is a remark, then
/// @throws std::runtime_error with every refusal and its fix; std::invalid_argument naming the key of a layout that
///         cannot be
[[nodiscard]] Surroundings prepare(const Configuration& configuration, bool allow_no_realtime);

}  // namespace nanomap
