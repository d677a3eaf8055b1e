#pragma once

#include <optional>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap {

/// How far stamps of a clock domain have to be moved to be of our clock. One number for all streams: what is fused by
/// time must not move against each other.
///
/// The time of day can be set while we run (NTP, an operator), and every stream that is stamped by it is set with it.
/// From then on there are two numbers, and a stamp tells by itself which one is its own: a moment from before the step
/// cannot lie behind it, nor one from after it before it. Only after a step back a stamp may fit both; then it is from
/// after the step, unless that would lie in our future. A stream whose own clock steps gets no such help: its stamps
/// are stale from then on, or of the future.
///
/// A log's number is that of its timeliest pose within kLogListening of the first: poses come with the least delay of
/// all that is sent, but the first ones of a log come late more often than not.
/// Threads: one. Reads no clock.
class StampClock {
 public:
  static constexpr Duration kLogListening = std::chrono::milliseconds(500);
  /// Both clocks are disciplined alike: a larger change of their difference is no error of measuring, but a step.
  static constexpr Duration kSmallestStep = std::chrono::milliseconds(2);

  /// @param max_lead        stamps that are farther ahead of their arrival are of the future (SafetyParameters)
  /// @param realtime_ahead  the realtime clock minus the monotonic one, now; of use with kRealtime
  StampClock(ClockDomain domain, Duration max_lead, Duration realtime_ahead);

  /// The realtime clock minus the monotonic one, measured again.
  /// @return how far the time of day was set meanwhile, if it was and counts: forward, if positive
  std::optional<Duration> noteRealtime(Duration realtime_ahead, Time now);

  /// What to add to the stamps of something that arrived at `arrival`; `stamp` is the newest of them. Empty: not known
  /// yet, and what arrived cannot be used.
  [[nodiscard]] std::optional<Duration> shift(InputKind kind, Time stamp, Time arrival);

 private:
  struct Step {
    Time earliest{};  ///< on our clock: when the time of day was last as it had been,
    Time latest{};    ///< and when it was first seen to be another
    Duration shift_before{};
  };

  [[nodiscard]] bool isFromBefore(const Step& step, Time stamp, Time arrival) const;

  ClockDomain domain_;
  Duration max_lead_;
  std::optional<Duration> shift_;
  Time measured_{};           ///< when the time of day was measured last
  std::optional<Step> step_;  ///< of the time of day, the last one
  std::optional<Time> listening_since_;
  Duration least_{};  ///< from stamp to arrival, of the poses so far
};

/// The newest stamp of it by which it can be placed in time; empty if it has none (a camera model).
[[nodiscard]] std::optional<Time> stampOf(const Input& input);

/// Moves every stamp. Stamps are kept within 0 .. 2^62 ns.
void shiftStamps(Input& input, Duration shift);

}  // namespace nanomap
