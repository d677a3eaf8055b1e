#include "drivers/mavlink/autopilot_clock.h"

#include <algorithm>

namespace nanomap {

Time AutopilotClock::toOurs(std::uint32_t time_boot_ms, Time arrival) {
  // Long enough to hold an undelayed message, short enough for clocks that drift by 100 ppm (1 ms in 10 s).
  constexpr Duration kPeriod = std::chrono::seconds(10);
  // No link delays by that much: the autopilot's clock has started anew.
  constexpr Duration kRestart = std::chrono::seconds(5);
  const Duration since_boot = std::chrono::milliseconds(time_boot_ms);
  const Duration arrival_offset = arrival.time_since_epoch() - since_boot;

  if (!period_ || arrival_offset > period_->least_offset + kRestart) {
    period_ = Period{arrival, arrival_offset};
    previous_offset_.reset();
  } else if (arrival - period_->start > kPeriod) {
    previous_offset_ = period_->least_offset;
    period_ = Period{arrival, arrival_offset};
  }
  period_->least_offset = std::min(period_->least_offset, arrival_offset);
  return Time(since_boot + offset());
}

std::optional<Duration> AutopilotClock::toTheirs(Time time) const {
  if (!period_) return std::nullopt;
  const Duration since_boot = time.time_since_epoch() - offset();
  if (since_boot < Duration::zero()) return std::nullopt;
  return since_boot;
}

Duration AutopilotClock::offset() const {
  return previous_offset_ ? std::min(*previous_offset_, period_->least_offset) : period_->least_offset;
}

}  // namespace nanomap
