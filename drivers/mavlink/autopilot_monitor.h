#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/ring_buffer.h"
#include "core/time.h"
#include "drivers/mavlink/autopilot_clock.h"
#include "drivers/mavlink/autopilot_messages.h"
#include "drivers/mavlink/autopilot_state.h"

namespace nanomap {

struct AutopilotMonitorCounters {
  std::uint64_t poses = 0;
  std::uint64_t poses_unmatched = 0;  ///< positions without an attitude near in time
  std::uint64_t poses_dropped = 0;    ///< the oldest of a full queue
};

/// Makes the autopilot's state and pose stream of its messages. Pure: time comes with the data. Threads: one.
class AutopilotMonitor {
 public:
  /// @param heartbeat_timeout  the link is up while the last heartbeat is younger
  explicit AutopilotMonitor(Duration heartbeat_timeout);

  void receive(const HeartbeatMessage& message, Time arrival);
  void receive(const LocalPositionMessage& message, Time arrival);
  void receive(const AttitudeMessage& message, Time arrival);
  void receive(const LandedStateMessage& message, Time arrival);

  [[nodiscard]] AutopilotState state(Time now) const;
  /// The oldest pose that nobody has taken yet.
  [[nodiscard]] std::optional<AutopilotPose> takePose();
  /// As AutopilotClock::toTheirs().
  [[nodiscard]] std::optional<Duration> sinceBoot(Time time) const { return clock_.toTheirs(time); }
  [[nodiscard]] const AutopilotMonitorCounters& counters() const { return counters_; }

 private:
  Duration heartbeat_timeout_;
  AutopilotState last_;  ///< but for what depends on the time it is asked for
  std::optional<Time> heartbeat_arrival_;
  std::optional<Time> position_arrival_;
  std::optional<Time> attitude_arrival_;
  AutopilotClock clock_;
  std::optional<AttitudeMessage> attitude_;
  RingBuffer<AutopilotPose> poses_;
  AutopilotMonitorCounters counters_;
};

}  // namespace nanomap
