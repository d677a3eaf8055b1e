#include "tools/replay/arrival_playback.h"

namespace nanomap {

ArrivalPlayback::ArrivalPlayback(LogReader& log, const Configuration& configuration, const LogSpan& span)
    : Playback(log, configuration, span) {
  std::erase_if(events_, [this](const LogEvent& event) { return event.log_stamp < from_ && !isHeld(kindOf(event)); });
}

std::optional<Time> ArrivalPlayback::nextStamp() const {
  if (next_ == events_.size()) return std::nullopt;
  const Time stamp = events_[next_].log_stamp;
  if (to_ && stamp > *to_) return std::nullopt;
  return stamp;
}

Playback::Progress ArrivalPlayback::advance() {
  const LogEvent& event = events_[next_++];
  Progress progress{.log_stamp = event.log_stamp, .outcome = pipeline_.feed(kindOf(event), read(event))};
  if (progress.outcome.views_inserted > 0) {
    progress.plans.push_back({.log_stamp = event.log_stamp, .place = {.sequence = plans_++}});
  }
  return progress;
}

}  // namespace nanomap
