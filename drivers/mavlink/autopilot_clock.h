#pragma once

#include <cstdint>
#include <optional>

#include "core/time.h"

namespace nanomap {

/// Puts the autopilot's stamps (32-bit milliseconds since its boot) on our timeline, from when its messages arrive: the
/// one that was least delayed of late tells the offset. A constant part of the delay cannot be seen.
/// Follows a reboot of the autopilot and the drift of its clock. Threads: one.
class AutopilotClock {
 public:
  /// When the message was stamped; never later than it arrived.
  Time toOurs(std::uint32_t time_boot_ms, Time arrival);

  /// What the autopilot's clock says at `time`, since its boot; empty before its first message, and before its boot.
  [[nodiscard]] std::optional<Duration> toTheirs(Time time) const;

 private:
  /// Ours less theirs. @pre a message has arrived
  [[nodiscard]] Duration offset() const;

  struct Period {
    Time start{};
    Duration least_offset{};
  };

  std::optional<Period> period_;
  std::optional<Duration> previous_offset_;  ///< the least of the period before
};

}  // namespace nanomap
