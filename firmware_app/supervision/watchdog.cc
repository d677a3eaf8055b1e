#include "firmware_app/supervision/watchdog.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nanomap {
namespace {

/// Empty: no limit.
std::optional<Duration> limitOf(const WatchedThread& thread, Activity activity) {
  switch (activity) {
    case Activity::kStarting:
    case Activity::kWorking:
      return thread.longest_work;
    case Activity::kWaiting:
      return thread.longest_wait;
    case Activity::kEnded:
      break;
  }
  return std::nullopt;
}

std::string milliseconds(Duration duration) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(duration).count()) + " ms";
}

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("watchdog: " + message);
}

}  // namespace

std::string toText(const Stall& stall) {
  const Duration limit = limitOf(*stall.thread, stall.activity).value_or(Duration::max());
  return stall.thread->name + " has been " + std::string(toString(stall.activity)) + " for " +
         milliseconds(stall.lasting) + ", " + milliseconds(limit) + " at most are allowed";
}

Watchdog::Watchdog(std::vector<WatchedThread> threads, Duration longest_pause)
    : threads_(std::move(threads)), longest_pause_(longest_pause) {
  require(longest_pause > Duration::zero(), "the longest pause must be positive");
  const auto of = [&](const WatchedThread& thread) {
    return " of thread " + thread.name + " must be above " + milliseconds(longest_pause) + ", the longest pause";
  };
  for (const WatchedThread& thread : threads_) {
    require(thread.progress != nullptr, "thread " + thread.name + " has no progress");
    require(thread.longest_work > longest_pause, "the longest work" + of(thread));
    require(!thread.longest_wait || *thread.longest_wait > longest_pause, "the longest wait" + of(thread));
    seen_.push_back({.reading = thread.progress->read(), .since = watched_});
  }
  stalls_.reserve(threads_.size());
}

std::span<const Stall> Watchdog::judge(Time now) {
  if (last_judged_) watched_ += std::clamp(now - *last_judged_, Duration::zero(), longest_pause_);
  last_judged_ = now;
  stalls_.clear();
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    const Progress::Reading reading = threads_[i].progress->read();
    if (reading != seen_[i].reading) seen_[i] = {.reading = reading, .since = watched_};
    const std::optional<Duration> limit = limitOf(threads_[i], reading.activity);
    const Duration lasting = watched_ - seen_[i].since;
    if (limit && lasting > *limit) stalls_.push_back({&threads_[i], reading.activity, lasting});
  }
  return stalls_;
}

}  // namespace nanomap
