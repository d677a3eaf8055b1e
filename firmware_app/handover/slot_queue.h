#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nanomap {

/// A bounded first-in-first-out queue from one thread to one other, of slots that are made once and go round: what a
/// slot owns (the pixels of an image, say) stays with it, and is reused.
/// Neither end waits, locks or allocates. Whoever finds it full drops the new one, which is counted.
/// Threads: one pushes, one pops; the counters from any.
template <class T>
class SlotQueue {
 public:
  /// Allocates: this many slots, each a copy of `slot`.
  explicit SlotQueue(std::size_t capacity, const T& slot = {})
      : slots_(capacity, slot), full_(capacity), free_(capacity) {
    for (T& each : slots_) free_.push(&each);
  }

  /// Producer: lets `fill(T&)` write into a free slot, as its last user left it, and queues it. False if none is free.
  template <class Fill>
  bool push(Fill&& fill) {
    T* slot = nullptr;
    if (!free_.pop(slot)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    std::forward<Fill>(fill)(*slot);
    full_.push(slot);
    return true;
  }

  /// Consumer: lets `use(T&)` have the oldest slot, which then goes back to the producer. False if there is none.
  template <class Use>
  bool pop(Use&& use) {
    T* slot = nullptr;
    if (!full_.pop(slot)) return false;
    std::forward<Use>(use)(*slot);
    free_.push(slot);
    return true;
  }

  /// For the producer: the next push() finds a free slot.
  [[nodiscard]] bool hasRoom() const { return free_.read_available() > 0; }

  /// Slots queued. A moment later it may be another number.
  [[nodiscard]] std::size_t size() const { return full_.read_available(); }
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<T> slots_;
  boost::lockfree::spsc_queue<T*> full_;
  boost::lockfree::spsc_queue<T*> free_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace nanomap
