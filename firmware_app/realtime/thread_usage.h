#pragma once

#include <atomic>
#include <cstdint>

#include "core/time.h"

namespace nanomap {

/// What the kernel has counted for one thread since it started.
struct ThreadUsage {
  Duration cpu_time{};                    ///< user and system
  std::int64_t minor_faults = 0;          ///< pages that were mapped without reading a disk
  std::int64_t major_faults = 0;          ///< pages that were read from a disk
  std::int64_t voluntary_switches = 0;    ///< waits
  std::int64_t involuntary_switches = 0;  ///< times that another thread took the core

  [[nodiscard]] std::int64_t faults() const { return minor_faults + major_faults; }
  friend ThreadUsage operator-(const ThreadUsage& later, const ThreadUsage& earlier);
  friend bool operator==(const ThreadUsage&, const ThreadUsage&) = default;
};

/// A thread's usage as it last told it: only the thread itself can ask the kernel (getrusage(2), RUSAGE_THREAD).
/// Threads: sample() by the one it is about; last() by any. Allocates: no.
class ThreadUsageMeter {
 public:
  /// One system call: for the end of a cycle, not for the middle of work.
  void sample() noexcept;

  /// The last sample, or zeros before the first. The values of one sample may mix with those of the next.
  [[nodiscard]] ThreadUsage last() const noexcept;

 private:
  std::atomic<std::int64_t> cpu_time_ns_ = 0;
  std::atomic<std::int64_t> minor_faults_ = 0;
  std::atomic<std::int64_t> major_faults_ = 0;
  std::atomic<std::int64_t> voluntary_switches_ = 0;
  std::atomic<std::int64_t> involuntary_switches_ = 0;
};

}  // namespace nanomap
