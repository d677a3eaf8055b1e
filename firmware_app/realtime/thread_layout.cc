#include "firmware_app/realtime/thread_layout.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace nanomap {
namespace {

using Places = std::array<std::size_t, kRealtimeThreadCount>;  ///< index of each thread's core among the usable ones

constexpr std::array<int, kRealtimeThreadCount> kPriorities = {40, 30, 35, 25, 45};
constexpr Places kOnOneCore = {0, 0, 0, 0, 0};
constexpr Places kOnTwoCores = {0, 0, 1, 1, 0};
constexpr Places kOnFourCores = {0, 1, 2, 3, 0};
constexpr Places kOnEightCores = {4, 5, 6, 7, 3};

const Places& placesFor(std::size_t cores) {
  if (cores >= 8) return kOnEightCores;
  if (cores >= 4) return kOnFourCores;
  return cores >= 2 ? kOnTwoCores : kOnOneCore;
}

std::string keyOf(RealtimeThread thread, std::string_view what) {
  return "realtime." + std::string(toString(thread)) + "_" + std::string(what);
}

std::string listOf(std::span<const int> numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

}  // namespace

std::string_view toString(RealtimeThread thread) {
  switch (thread) {
    case RealtimeThread::kCapture:
      return "capture";
    case RealtimeThread::kIndex:
      return "index";
    case RealtimeThread::kChain:
      return "chain";
    case RealtimeThread::kPlanner:
      return "planner";
    case RealtimeThread::kWatchdog:
      return "watchdog";
  }
  return "?";
}

int ThreadLayout::highestPriority() const { return std::ranges::max(places, {}, &ThreadPlace::priority).priority; }

ThreadLayout defaultLayout(std::span<const int> cores) {
  const Places& chosen = placesFor(cores.size());
  ThreadLayout layout;
  for (std::size_t i = 0; i < kRealtimeThreadCount; ++i) layout.places[i] = {cores[chosen[i]], kPriorities[i]};
  return layout;
}

void checkLayout(const ThreadLayout& layout, std::span<const int> cores) {
  const int watchdog_priority = layout[RealtimeThread::kWatchdog].priority;
  for (std::size_t i = 0; i < kRealtimeThreadCount; ++i) {
    const auto thread = static_cast<RealtimeThread>(i);
    const auto [core, priority] = layout[thread];
    if (std::ranges::find(cores, core) == cores.end()) {
      throw std::invalid_argument(keyOf(thread, "core") + " is " + std::to_string(core) +
                                  ", but this process may use the cores " + listOf(cores));
    }
    if (priority < 1 || priority >= kInterruptPriority) {
      throw std::invalid_argument(keyOf(thread, "priority") + " is " + std::to_string(priority) +
                                  ", but must be 1 .. " + std::to_string(kInterruptPriority - 1) +
                                  ": below the kernel's interrupt threads");
    }
    if (thread != RealtimeThread::kWatchdog && priority >= watchdog_priority) {
      throw std::invalid_argument(keyOf(thread, "priority") + " is " + std::to_string(priority) +
                                  ", but must be below " + keyOf(RealtimeThread::kWatchdog, "priority") +
                                  ", which is " + std::to_string(watchdog_priority) +
                                  ": a busy thread must not hide from the watchdog");
    }
  }
}

}  // namespace nanomap
