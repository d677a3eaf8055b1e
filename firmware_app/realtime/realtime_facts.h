#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace nanomap {

/// What the machine says about real time, before anything is judged.
struct RealtimeFacts {
  std::vector<int> cores;                                  ///< that this process may use, ascending
  int tried_priority = 0;                                  ///< of SCHED_FIFO
  int fifo_error = 0;                                      ///< errno of that trial; 0: granted
  std::uint64_t priority_limit = 0;                        ///< RLIMIT_RTPRIO
  std::optional<std::uint64_t> locked_memory_limit_bytes;  ///< RLIMIT_MEMLOCK; empty: unlimited
  bool may_schedule = false;                               ///< CAP_SYS_NICE
  bool may_lock_memory = false;                            ///< CAP_IPC_LOCK
  std::optional<Duration> realtime_share;  ///< that real-time threads may use of each period; empty: all of it
  Duration realtime_period{};
  std::string program;  ///< path of the executable
};

/// Asks the kernel. Tries SCHED_FIFO on a thread of its own, which does nothing else.
/// @param priority  to try
[[nodiscard]] RealtimeFacts gatherRealtimeFacts(int priority);

/// Path of this process's executable; empty where /proc is missing.
[[nodiscard]] std::string programPath();

/// Whether a capability is effective, by the text of /proc/PID/status. @param bit  as CAP_SYS_NICE of capability.h
[[nodiscard]] bool hasCapability(std::string_view status, int bit);

}  // namespace nanomap
