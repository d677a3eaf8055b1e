#include "tools/replay/playback.h"

#include <stdexcept>

namespace nanomap {
namespace {

bool holdsFromThenOn(InputKind kind) { return kind == InputKind::kCamera || kind == InputKind::kGoal; }

}  // namespace

Playback::Playback(LogReader& log, const Configuration& configuration, const LogSpan& span)
    : log_(log), pipeline_(configuration), events_(log.mergedByTime()) {
  if (events_.empty())
    throw std::runtime_error("the log holds no event: was anything published while it was recorded?");
  log_start_ = events_.front().log_stamp;
  log_end_ = events_.back().log_stamp;
  if (span.to) to_ = log_start_ + *span.to;
  const Time from = log_start_ + span.from;
  std::erase_if(events_, [&](const LogEvent& event) {
    const auto kind = pipeline_.kindOf(log_.channelOf(event));
    return !kind || (event.log_stamp < from && !holdsFromThenOn(*kind));
  });
}

std::optional<Time> Playback::nextStamp() const {
  if (next_ == events_.size()) return std::nullopt;
  const Time stamp = events_[next_].log_stamp;
  if (to_ && stamp > *to_) return std::nullopt;
  return stamp;
}

Playback::Step Playback::step() {
  const LogEvent& event = events_[next_++];
  log_.read(event, message_);
  return {event.log_stamp, pipeline_.feed(*pipeline_.kindOf(log_.channelOf(event)), message_)};
}

}  // namespace nanomap
