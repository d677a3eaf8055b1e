#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace nanomap {

/// What a thread does, as it told last.
enum class Activity : std::uint8_t {
  kStarting,  ///< it has told nothing yet
  kWorking,   ///< on one piece of work, which has an end
  kWaiting,   ///< for something to do
  kEnded,     ///< it has nothing to do any more
};

[[nodiscard]] std::string_view toString(Activity activity);

/// A thread's sign of life, without a clock: whoever watches it sees when it changes.
/// Threads: told by one, read by any; neither waits. Allocates: no.
class Progress {
 public:
  /// To be told again at each piece of work.
  void working() noexcept { tell(Activity::kWorking); }
  void waiting() noexcept { tell(Activity::kWaiting); }
  void ended() noexcept { tell(Activity::kEnded); }

  struct Reading {
    Activity activity = Activity::kStarting;
    std::uint64_t times_told = 0;

    friend bool operator==(const Reading&, const Reading&) = default;
  };
  [[nodiscard]] Reading read() const noexcept;

 private:
  void tell(Activity activity) noexcept;

  static constexpr unsigned kActivityBits = 2;
  std::atomic<std::uint64_t> told_ = 0;  ///< times told, then the activity in the lowest bits: both at once
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace nanomap
