#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace nanomap {

/// Room for the newest value from one thread to one other: a value that nobody has taken yet is replaced, which is
/// counted. Three slots, made once and swapped: one with each end, one between them.
/// Neither end waits, locks or allocates, and each may keep its slot for as long as it likes.
/// Threads: one puts, one takes; the counter from any.
template <class T>
class Mailbox {
 public:
  explicit Mailbox(const T& slot = {}) : slots_{slot, slot, slot} {}

  /// Producer: lets `fill(T&)` write into a slot, as some earlier user left it, and puts it.
  template <class Fill>
  void put(Fill&& fill) {
    std::forward<Fill>(fill)(slots_[back_]);
    const std::uint8_t replaced =
        middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel);
    if ((replaced & kFresh) != 0) replaced_.fetch_add(1, std::memory_order_relaxed);
    back_ = replaced & kIndex;
  }

  /// Consumer: lets `use(T&)` have the newest value. False if nothing was put since the last time.
  template <class Use>
  bool take(Use&& use) {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    std::forward<Use>(use)(slots_[front_]);
    return true;
  }

  /// Values that were put and never taken.
  [[nodiscard]] std::uint64_t replaced() const { return replaced_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<T, 3> slots_;
  std::uint8_t back_ = 0;                ///< the producer's
  std::atomic<std::uint8_t> middle_{1};  ///< its index, and whether it is fresh
  std::uint8_t front_ = 2;               ///< the consumer's
  std::atomic<std::uint64_t> replaced_{0};
};

}  // namespace nanomap
