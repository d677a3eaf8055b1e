#pragma once

#include <optional>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap {

/// How far stamps of a clock domain have to be moved to be of our clock. One number for the whole run: what is fused by
/// time must not move against each other. A realtime clock that is set meanwhile shows in the age of what arrives.
///
/// A log's number is that of its timeliest pose within kLogListening of the first: poses come with the least delay of
/// all that is sent, but the first ones of a log come late more often than not.
/// Threads: one. Reads no clock.
class StampClock {
 public:
  static constexpr Duration kLogListening = std::chrono::milliseconds(500);

  /// @param realtime_ahead  the realtime clock minus the monotonic one, now; of use with kRealtime
  StampClock(ClockDomain domain, Duration realtime_ahead);

  /// What to add to the stamps of something that arrived at `arrival`; `stamp` is the newest of them. Empty: not known
  /// yet, and what arrived cannot be used.
  [[nodiscard]] std::optional<Duration> shift(InputKind kind, Time stamp, Time arrival);

 private:
  std::optional<Duration> shift_;
  std::optional<Time> listening_since_;
  Duration least_{};  ///< from stamp to arrival, of the poses so far
};

/// The newest stamp of it by which it can be placed in time; empty if it has none (a camera model).
[[nodiscard]] std::optional<Time> stampOf(const Input& input);

/// Moves every stamp. Stamps are kept within 0 .. 2^62 ns.
void shiftStamps(Input& input, Duration shift);

}  // namespace nanomap
