#include "tools/replay/playback.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tools/replay/arrival_playback.h"
#include "tools/replay/step_playback.h"

namespace nanomap {

Playback::Playback(LogReader& log, const Configuration& configuration, const LogSpan& span)
    : log_(log), pipeline_(configuration), events_(log.mergedByTime()) {
  if (events_.empty())
    throw std::runtime_error("the log holds no event: was anything published while it was recorded?");
  log_start_ = events_.front().log_stamp;
  log_end_ = events_.back().log_stamp;
  from_ = log_start_ + span.from;
  if (span.to) to_ = log_start_ + *span.to;
  std::erase_if(events_, [this](const LogEvent& event) { return !pipeline_.kindOf(log_.channelOf(event)); });
}

Bytes Playback::read(const LogEvent& event) {
  log_.read(event, message_);
  return message_;
}

bool Playback::isHeld(InputKind kind) {
  return std::find(kHeldKinds.begin(), kHeldKinds.end(), kind) != kHeldKinds.end();
}

std::unique_ptr<Playback> makePlayback(LogReader& log, const Configuration& configuration, const LogSpan& span) {
  FlightScript script = readFlightScript(log, configuration.lcm);
  if (script.steps.empty()) return std::make_unique<ArrivalPlayback>(log, configuration, span);
  return std::make_unique<StepPlayback>(log, configuration, span, std::move(script));
}

}  // namespace nanomap
