#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/time.h"

namespace nanomap {

/// What of one stream did not come as it was sent. A message that came and could not be read is missing, too.
struct StreamLoss {
  std::uint64_t missing = 0;      ///< by the publisher's count: sent, and never came
  std::uint64_t suspected = 0;    ///< of a publisher that does not count: as many as would have filled its pauses
  std::uint64_t repeated = 0;     ///< came again
  std::uint64_t late = 0;         ///< came after a younger one; no longer missing
  std::uint64_t began_again = 0;  ///< the publisher has started anew, or has paused: nothing is known of the gap

  [[nodiscard]] std::uint64_t lost() const { return missing + suspected; }
};

/// A stream that is silent for longer has been switched off, and a message that is older than the newest by more did
/// not come late: the publisher has started anew.
inline constexpr Duration kMaxPause = std::chrono::seconds(5);

/// Counts what is lost of a stream whose publisher numbers its messages. A message with a number from before and a
/// stamp from after the newest one's is the first of a publisher that has started anew, and so is one that leaps ahead
/// of all that can have been lost: neither is a loss. One that does not count at all starts anew all the time.
/// Threads: one. Allocates: no.
class NumberedStream {
 public:
  /// A larger step of the count is another count.
  static constexpr std::uint64_t kMaxGap = 10'000;

  void arrived(std::uint64_t sequence, Time stamp);

  [[nodiscard]] const StreamLoss& loss() const { return loss_; }

 private:
  static constexpr std::uint64_t kRemembered = 64;  ///< a message that comes later than that stays missing

  struct Newest {
    std::uint64_t sequence = 0;
    Time stamp{};
  };

  void begin(const Newest& message);
  void advance(const Newest& message);

  std::optional<Newest> newest_;
  std::bitset<kRemembered> missing_;  ///< what has not come of the numbers before the newest: bit 1 is the last one
  StreamLoss loss_;
};

/// Counts what seems to be lost of a stream that has stamps only: where one is much farther from the one before than
/// is usual, as many messages as fit in between. Usual is the median of the last intervals, so that a stream that
/// changes its rate, or is often interrupted, is soon known for what it is.
/// Threads: one. Allocates: no.
class StampedStream {
 public:
  /// Intervals that have to be known first.
  static constexpr std::size_t kKnownIntervals = 15;

  void arrived(Time stamp);

  [[nodiscard]] const StreamLoss& loss() const { return loss_; }

 private:
  [[nodiscard]] Duration usualInterval() const;

  std::optional<Time> newest_;
  std::array<Duration, kKnownIntervals> intervals_{};  ///< the last ones, in a ring
  std::size_t intervals_seen_ = 0;
  StreamLoss loss_;
};

}  // namespace nanomap
