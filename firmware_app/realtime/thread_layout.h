#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace nanomap {

/// The threads that are pinned and scheduled in real time. All others are plain ones.
enum class RealtimeThread : std::uint8_t { kCapture, kIndex, kChain, kPlanner, kWatchdog };
inline constexpr std::size_t kRealtimeThreadCount = 5;

/// As in the configuration and in the thread's name: "capture".
[[nodiscard]] std::string_view toString(RealtimeThread thread);

/// SCHED_FIFO priority of Linux's threaded interrupt handlers; whoever is above them can starve the devices.
inline constexpr int kInterruptPriority = 50;

/// Where a real-time thread runs and before whom.
struct ThreadPlace {
  int core = 0;
  int priority = 0;  ///< of SCHED_FIFO: 1 up to below kInterruptPriority; higher goes first

  friend bool operator==(const ThreadPlace&, const ThreadPlace&) = default;
};

struct ThreadLayout {
  [[nodiscard]] ThreadPlace& operator[](RealtimeThread thread) { return places[static_cast<std::size_t>(thread)]; }
  [[nodiscard]] const ThreadPlace& operator[](RealtimeThread thread) const {
    return places[static_cast<std::size_t>(thread)];
  }
  [[nodiscard]] int highestPriority() const;

  std::array<ThreadPlace, kRealtimeThreadCount> places{};  ///< in the order of RealtimeThread

  friend bool operator==(const ThreadLayout&, const ThreadLayout&) = default;
};

/// The layout for a machine. The watchdog goes before all; then the shorter the work, the sooner: capture, chain,
/// index, planner.
///   2 cores  capture, index and watchdog on the first; chain and planner on the second
///   4 cores  one each, the watchdog with capture
///   8 cores  one each of the fifth to eighth, the watchdog on the fourth: the first ones stay with the interrupts and
///            the plain threads, and where a core counts as two, those four are commonly one half of each
/// In between as for the next smaller number; with one core all share it.
/// @param cores  that the process may use, ascending, at least one
[[nodiscard]] ThreadLayout defaultLayout(std::span<const int> cores);

/// @param cores  that the process may use, ascending
/// @throws std::invalid_argument naming the key, as realtime.planner_core, and what it may be
void checkLayout(const ThreadLayout& layout, std::span<const int> cores);

}  // namespace nanomap
