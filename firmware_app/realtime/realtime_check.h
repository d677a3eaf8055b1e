#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "firmware_app/realtime/memory_lock.h"
#include "firmware_app/realtime/realtime_facts.h"

namespace nanomap {

struct RealtimeNeeds {
  std::size_t cores = 2;
  bool locked_memory = kLocksMemory;
};

/// Something about the machine that a pilot's engineer should know, and the way out.
struct RealtimeFinding {
  bool refusal = true;  ///< the process cannot run in real time; otherwise it can, and this is good to know
  std::string reason;
  std::string fix;
};

/// What of the needs the machine does not grant.
[[nodiscard]] std::vector<RealtimeFinding> judgeRealtime(const RealtimeFacts& facts, const RealtimeNeeds& needs);

[[nodiscard]] bool grantsRealtime(std::span<const RealtimeFinding> findings);

/// One paragraph a finding: its reason and its fix.
[[nodiscard]] std::string toText(std::span<const RealtimeFinding> findings);

/// Where the rights come from that real time needs: for messages.
/// @param program  path of the executable
[[nodiscard]] std::string privilegeFix(const std::string& program);

}  // namespace nanomap
