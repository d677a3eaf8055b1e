#pragma once

#include "core/time.h"

namespace nanomap {

/// The process's clock: CLOCK_MONOTONIC of this machine. The only clock that stages are driven by.
[[nodiscard]] Time processNow();

/// The time of day minus that, now.
[[nodiscard]] Duration realtimeAhead();

/// Returns at `time`, at once if that is past, or earlier at a signal.
void sleepUntil(Time time);

}  // namespace nanomap
