#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "firmware_app/realtime/stage_thread.h"
#include "firmware_app/realtime/thread_usage.h"
#include "firmware_app/supervision/progress.h"

namespace nanomap {

/// A thread that does the same thing again and again: waits for work, then does it. It shows signs of life, and counts
/// what the kernel and the allocator did for it.
/// Threads: made and destroyed by one; the counters are for any.
class Worker {
 public:
  /// @param wait  returns when there may be work, and after 0.1 s at the latest: a stop is noticed in between
  /// @param work  what there is
  /// @throws as StageThread does
  Worker(const ThreadSettings& settings, std::function<void()> wait, std::function<void()> work);

  [[nodiscard]] const ThreadSettings& settings() const { return settings_; }
  [[nodiscard]] const Progress& progress() const { return progress_; }
  [[nodiscard]] ThreadUsage usage() const { return usage_.last(); }
  [[nodiscard]] std::uint64_t allocations() const { return allocations_.load(std::memory_order_relaxed); }
  [[nodiscard]] const std::optional<std::string>& refusal() const { return thread_->refusal(); }
  void requestStop() { thread_->requestStop(); }

 private:
  void run(const std::stop_token& stop);

  ThreadSettings settings_;
  std::function<void()> wait_;
  std::function<void()> work_;
  Progress progress_;
  ThreadUsageMeter usage_;
  std::atomic<std::uint64_t> allocations_{0};
  std::unique_ptr<StageThread> thread_;  ///< last: it runs while the others are there
};

}  // namespace nanomap
