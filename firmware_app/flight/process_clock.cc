#include "firmware_app/flight/process_clock.h"

#include <ctime>

namespace nanomap {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Two clocks cannot be read at once: what interrupts us in between goes into their difference.
constexpr Duration kUninterrupted = std::chrono::microseconds(20);
constexpr int kMostReadings = 5;

std::int64_t read_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

}  // namespace

Time processNow() { return timeFromNanoseconds(read_ns(CLOCK_MONOTONIC)); }

Duration realtimeAhead() {
  Duration narrowest = Duration::max();
  Duration ahead{};
  for (int i = 0; i < kMostReadings; ++i) {
    const std::int64_t before_ns = read_ns(CLOCK_MONOTONIC);
    const std::int64_t realtime_ns = read_ns(CLOCK_REALTIME);
    const Duration took(read_ns(CLOCK_MONOTONIC) - before_ns);
    if (took >= narrowest) continue;
    narrowest = took;
    ahead = Duration(realtime_ns - before_ns) - took / 2;
    if (took < kUninterrupted) break;
  }
  return ahead;
}

void sleepUntil(Time time) {
  const std::int64_t ns = toNanoseconds(time);
  const timespec deadline{ns / kSecond_ns, ns % kSecond_ns};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
}

}  // namespace nanomap
