#include "firmware_app/realtime/thread_usage.h"

#include <sys/resource.h>

#include <chrono>

namespace nanomap {
namespace {

Duration toDuration(const timeval& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
}

}  // namespace

ThreadUsage operator-(const ThreadUsage& later, const ThreadUsage& earlier) {
  return {.cpu_time = later.cpu_time - earlier.cpu_time,
          .minor_faults = later.minor_faults - earlier.minor_faults,
          .major_faults = later.major_faults - earlier.major_faults,
          .voluntary_switches = later.voluntary_switches - earlier.voluntary_switches,
          .involuntary_switches = later.involuntary_switches - earlier.involuntary_switches};
}

void ThreadUsageMeter::sample() noexcept {
  rusage usage{};
  if (getrusage(RUSAGE_THREAD, &usage) != 0) return;
  constexpr auto kEachByItself = std::memory_order_relaxed;
  cpu_time_ns_.store((toDuration(usage.ru_utime) + toDuration(usage.ru_stime)).count(), kEachByItself);
  minor_faults_.store(usage.ru_minflt, kEachByItself);
  major_faults_.store(usage.ru_majflt, kEachByItself);
  voluntary_switches_.store(usage.ru_nvcsw, kEachByItself);
  involuntary_switches_.store(usage.ru_nivcsw, kEachByItself);
}

ThreadUsage ThreadUsageMeter::last() const noexcept {
  constexpr auto kEachByItself = std::memory_order_relaxed;
  return {.cpu_time = Duration(cpu_time_ns_.load(kEachByItself)),
          .minor_faults = minor_faults_.load(kEachByItself),
          .major_faults = major_faults_.load(kEachByItself),
          .voluntary_switches = voluntary_switches_.load(kEachByItself),
          .involuntary_switches = involuntary_switches_.load(kEachByItself)};
}

}  // namespace nanomap
