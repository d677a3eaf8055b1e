#include "tools/replay/step_playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "firmware_app/pipeline/stamp_clock.h"

namespace nanomap {

StepPlayback::StepPlayback(LogReader& log, const Configuration& configuration, const LogSpan& span, FlightScript script)
    : Playback(log, configuration, span), steps_(std::move(script.steps)), plans_(std::move(script.plans)) {
  const std::uint64_t first = steps_.front().number;
  report_.losses = std::move(script.losses);
  std::erase_if(steps_, [this](const Step& step) { return step.taken < from_ && !isHeld(step.kind); });
  for (const Step& step : steps_) wanted_.insert(keyOf(step));
  if (first != 1) {
    for (const InputKind kind : kHeldKinds) takeWhatHeld(kind);
  }

  const auto dropped = std::erase_if(plans_, [first](const RecordedPlan& plan) { return plan.step < first; });
  if (dropped > 0) lose(log_start_, fmt::format("{} decisions were made before the first step", dropped));
  std::erase_if(plans_, [this](const RecordedPlan& plan) { return plan.log_stamp < from_; });
}

std::optional<Time> StepPlayback::nextStamp() const {
  if (next_step_ == steps_.size()) return std::nullopt;
  const Time stamp = steps_[next_step_].taken;
  if (to_ && stamp > *to_) return std::nullopt;
  return stamp;
}

Playback::Progress StepPlayback::advance() {
  const Step& step = steps_[next_step_++];
  readUpTo(step.arrival);
  Progress progress{.log_stamp = step.taken, .outcome = {}};
  if (auto input = waiting_.extract(keyOf(step)); !input.empty()) {
    shiftStamps(input.mapped(), step.stamp_shift);
    progress.outcome = pipeline_.take(std::move(input.mapped()));
    ++report_.taken;
  } else {
    lose(step.taken, fmt::format("the message that step {} took in ({}) is missing or cannot be read", step.number,
                                 toString(step.kind)));
  }
  for (; plansAreDue(); ++next_plan_) {
    const RecordedPlan& plan = plans_[next_plan_];
    if (pipeline_.state()) {
      progress.plans.push_back({.log_stamp = plan.log_stamp,
                                .now = plan.now,
                                .place = {.sequence = plan.sequence, .step = plan.step, .flown = plan.flown}});
    } else {
      lose(plan.log_stamp, fmt::format("decision {} cannot be made again: there is no pose before it", plan.sequence));
    }
  }
  return progress;
}

void StepPlayback::readUpTo(Time arrival) {
  for (; next_event_ < events_.size() && events_[next_event_].log_stamp <= arrival; ++next_event_) {
    const LogEvent& event = events_[next_event_];
    const InputKind kind = kindOf(event);
    auto input = pipeline_.read(kind, read(event));
    const Key key(kind, event.log_stamp);
    if (!input) continue;
    if (wanted_.contains(key)) {
      waiting_.insert_or_assign(key, *std::move(input));
    } else {
      ++report_.not_taken[static_cast<std::size_t>(kind)];
    }
  }
}

void StepPlayback::takeWhatHeld(InputKind kind) {
  const auto first =
      std::find_if(events_.begin(), events_.end(), [&](const LogEvent& event) { return kindOf(event) == kind; });
  if (first == events_.end() || wanted_.contains({kind, first->log_stamp})) return;
  if (auto input = pipeline_.read(kind, read(*first))) (void)pipeline_.take(*std::move(input));
  events_.erase(first);
}

bool StepPlayback::plansAreDue() const {
  if (next_plan_ == plans_.size()) return false;
  const bool last_step = next_step_ == steps_.size();
  return last_step || plans_[next_plan_].step < steps_[next_step_].number;
}

void StepPlayback::lose(Time at, std::string what) {
  const auto later = std::upper_bound(report_.losses.begin(), report_.losses.end(), at,
                                      [](Time time, const RecordingLoss& loss) { return time < loss.at; });
  report_.losses.insert(later, {at, std::move(what)});
}

}  // namespace nanomap
