#pragma once

#include <csignal>

#include "core/time.h"

namespace nanomap {

/// SIGINT and SIGTERM, which ask the process to end: from then on they interrupt nobody, and wait to be taken. Threads
/// that are made later leave them alone, too. Threads: the one that made it.
class EndSignals {
 public:
  EndSignals();

  /// Waits for one at most this long; true if it came.
  [[nodiscard]] bool wait(Duration at_most) const;

 private:
  sigset_t set_{};
};

}  // namespace nanomap
