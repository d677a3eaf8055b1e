#include "firmware_app/flight/process_clock.h"

#include <ctime>

namespace nanomap {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t read_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

}  // namespace

Time processNow() { return timeFromNanoseconds(read_ns(CLOCK_MONOTONIC)); }

Duration realtimeAhead() { return Duration(read_ns(CLOCK_REALTIME) - read_ns(CLOCK_MONOTONIC)); }

void sleepUntil(Time time) {
  const std::int64_t ns = toNanoseconds(time);
  const timespec deadline{ns / kSecond_ns, ns % kSecond_ns};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
}

}  // namespace nanomap
