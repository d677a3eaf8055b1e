#include "drivers/recording/log_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

namespace nanomap {

LogClock monotonicLogClock() {
  using Clock = std::chrono::steady_clock;
  return {.now = [] { return Time(std::chrono::duration_cast<Duration>(Clock::now().time_since_epoch())); },
          .wait_until = [](Time time) { std::this_thread::sleep_until(Clock::time_point(time.time_since_epoch())); }};
}

LogSource::LogSource(LogReader log, const std::vector<std::string>& channels, double rate, LogClock clock)
    : log_(std::move(log)), clock_(std::move(clock)) {
  if (!(rate > 0.0) || !std::isfinite(rate)) {
    throw std::invalid_argument("The rate at which a log is played must be positive, not " + std::to_string(rate) +
                                ": 1 is as it was recorded.");
  }
  Duration due{};
  std::optional<Time> previous;
  for (const LogEvent& event : log_.mergedByTime()) {
    if (std::find(channels.begin(), channels.end(), log_.channelOf(event)) == channels.end()) continue;
    if (previous) {
      const Duration pause = std::min(event.log_stamp - *previous, kLongestLogPause);
      due += fromSeconds(toSeconds(pause) / rate);
    }
    previous = event.log_stamp;
    items_.push_back({event, due});
  }
}

MessageSource::Wait LogSource::wait(Duration timeout, const Handler& handler) {
  if (next_ == items_.size()) return Wait::kEnded;
  const Time called = clock_.now();
  if (!start_) start_ = called;
  const Time next_due = *start_ + items_[next_].due;
  if (next_due > called) clock_.wait_until(std::min(next_due, called + timeout));

  const Time now = clock_.now();
  bool handled = false;
  while (next_ < items_.size() && *start_ + items_[next_].due <= now) {
    if (!read(items_[next_++].event)) continue;
    handled = true;
    handler(message_);
  }
  return handled ? Wait::kHandled : Wait::kTimeout;
}

bool LogSource::read(const LogEvent& event) {
  try {
    log_.read(event, bytes_);
  } catch (const LogError&) {
    ++unreadable_;
    return false;
  }
  message_ = {.channel = log_.channelOf(event), .bytes = bytes_, .log_stamp = event.log_stamp};
  return true;
}

}  // namespace nanomap
