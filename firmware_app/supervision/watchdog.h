#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/time.h"
#include "firmware_app/supervision/progress.h"

namespace nanomap {

struct WatchedThread {
  std::string name;
  const Progress* progress = nullptr;    ///< outlives the watchdog
  Duration longest_work{};               ///< that one piece of work, or starting, may take
  std::optional<Duration> longest_wait;  ///< empty: it may wait for ever
};

/// A thread that shows no sign of life for longer than it may.
struct Stall {
  const WatchedThread* thread = nullptr;  ///< of the watchdog that says so
  Activity activity = Activity::kWorking;
  Duration lasting{};
};

/// "planner has been working for 320 ms, 300 ms at most are allowed".
[[nodiscard]] std::string toText(const Stall& stall);

/// Judges which threads are stalled: those whose progress has not changed for longer than they may work or wait. A
/// thread that has ended is none. Time counts from when a change was seen, so that a stall is told late by one period
/// of judging at most.
///
/// A pause of the watchdog itself, as when the whole process was stopped and goes on, counts as `longest_pause` at
/// most: it says nothing about the others. A watchdog that is always late still finds who is stalled. Threads: one.
/// Allocates: at construction.
class Watchdog {
 public:
  /// @param longest_pause  between two judgements that come as they should; below every limit of a thread
  /// @throws std::invalid_argument naming the thread and the limit
  Watchdog(std::vector<WatchedThread> threads, Duration longest_pause);
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Who is stalled now, in the order of the threads; until the next call.
  [[nodiscard]] std::span<const Stall> judge(Time now);

 private:
  struct Seen {
    Progress::Reading reading;
    Duration since{};  ///< watched time when that was first seen
  };

  std::vector<WatchedThread> threads_;
  Duration longest_pause_;
  std::vector<Seen> seen_;  ///< of each thread
  std::vector<Stall> stalls_;
  std::optional<Time> last_judged_;
  Duration watched_{};  ///< time that has passed, pauses cut
};

}  // namespace nanomap
