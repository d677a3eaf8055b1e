#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace nanomap {

using Duration = std::chrono::nanoseconds;

/// The one monotonic timeline every stamp lives on. It has no `now()`: data carry time, and the clocks that
/// produce it are read in `drivers` and `firmware_app` only.
struct Timeline {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<Timeline, Duration>;
  static constexpr bool is_steady = true;
};

/// A stamp, in integer nanoseconds. Stamps that enter from outside are limited to 0 .. 2^62 ns at the edge, so that
/// the difference of any two fits.
using Time = std::chrono::time_point<Timeline, Duration>;

/// [s]. For display, rates and interpolation weights; never to identify a moment.
[[nodiscard]] constexpr double toSeconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

/// How far from `from` to `to` a moment lies: 0 at `from`, 1 at `to`. @pre `from` is before `to`
[[nodiscard]] constexpr double shareOf(Time moment, Time from, Time to) {
  return static_cast<double>((moment - from).count()) / static_cast<double>((to - from).count());
}

/// Nearest nanosecond to `seconds` [s].
[[nodiscard]] inline Duration fromSeconds(double seconds) { return Duration(std::llround(seconds * 1e9)); }

[[nodiscard]] constexpr Time timeFromNanoseconds(std::int64_t ns) { return Time(Duration(ns)); }

[[nodiscard]] constexpr std::int64_t toNanoseconds(Time time) { return time.time_since_epoch().count(); }

}  // namespace nanomap
