#pragma once

#include <atomic>
#include <cstdint>

#include "core/time.h"

namespace nanomap {

/// Counts depth frames that a stage was done with too late. Of several that it was done with at once, the newest tells.
/// Threads: one tells; the counter is for any. Allocates: no.
class FrameDeadline {
 public:
  /// @param limit  from a frame's arrival
  explicit FrameDeadline(Duration limit) : limit_(limit) {}

  /// The stage is done with the frame of that arrival, or with something else since that frame.
  void done(Time arrival, Time now) {
    if (arrival <= last_) return;
    last_ = arrival;
    if (now - arrival > limit_) missed_.fetch_add(1, std::memory_order_relaxed);
  }

  [[nodiscard]] std::uint64_t missed() const { return missed_.load(std::memory_order_relaxed); }

 private:
  Duration limit_;
  Time last_{};
  std::atomic<std::uint64_t> missed_{0};
};

}  // namespace nanomap
