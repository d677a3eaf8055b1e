#pragma once

#include <pthread.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "firmware_app/realtime/thread_layout.h"

namespace nanomap {

inline constexpr std::size_t kDefaultStackBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMinStackBytes = std::size_t{1} << 17;

struct ThreadSettings {
  std::string name;                    ///< 1 to 15 bytes, for ps, top and gdb
  std::optional<ThreadPlace> place{};  ///< empty: a plain thread, on any core, whoever makes it
  std::size_t stack_bytes = kDefaultStackBytes;
  bool demand_realtime = true;  ///< false: where the machine refuses the place, run as far as it grants it
};

/// A thread with a name, a stack whose pages are all there, and, if it has a place, a core and a SCHED_FIFO priority of
/// its own. Signals are left to the other threads, except those that a fault of its own raises.
/// Threads: made, stopped and destroyed by one.
class StageThread {
 public:
  /// Runs until it returns, which it must do soon after a stop is requested. Must not throw.
  using Body = std::function<void(std::stop_token)>;

  /// Starts the thread and returns when it is all set up, right before `body`.
  /// @throws std::invalid_argument naming the thread and the setting; std::runtime_error naming the thread, what the
  ///         machine refused and what to do; the body does not run then
  StageThread(const ThreadSettings& settings, Body body);

  /// Requests a stop and waits for the body to return.
  ~StageThread();

  StageThread(const StageThread&) = delete;
  StageThread& operator=(const StageThread&) = delete;

  void requestStop() noexcept;

  /// What the machine refused of the place, if that was allowed to it.
  [[nodiscard]] const std::optional<std::string>& refusal() const;

 private:
  struct Running;

  std::unique_ptr<Running> running_;
  pthread_t thread_{};
};

}  // namespace nanomap
