#pragma once

#include <optional>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap {

/// How far stamps of a clock domain have to be moved to be of our clock. One number for the whole run: what is fused by
/// time must not move against each other. A realtime clock that is set meanwhile shows in the age of what arrives.
///
/// A log's number comes from its first pose, which is the timeliest of all that is sent, and puts it a little into the
/// past, so that no pose comes from the future if the first was late.
/// Threads: one. Reads no clock.
class StampClock {
 public:
  /// @param realtime_ahead  the realtime clock minus the monotonic one, now; of use with kRealtime
  StampClock(ClockDomain domain, Duration realtime_ahead);

  /// What to add to the stamps of something that arrived at `arrival`; `stamp` is the newest of them. Before a log's
  /// first pose each thing is taken to be of its arrival.
  [[nodiscard]] Duration shift(InputKind kind, Time stamp, Time arrival);

 private:
  std::optional<Duration> shift_;
};

/// The newest stamp of it by which it can be placed in time; empty if it has none (a camera model).
[[nodiscard]] std::optional<Time> stampOf(const Input& input);

/// Moves every stamp. Stamps are kept within 0 .. 2^62 ns.
void shiftStamps(Input& input, Duration shift);

}  // namespace nanomap
