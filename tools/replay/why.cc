#include "tools/replay/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "planner/planner.h"
#include "tools/replay/explanation_text.h"
#include "tools/replay/moment.h"
#include "tools/replay/playback.h"

namespace nanomap {
namespace {

/// Runs on until a plan is due. @return its log time
Time runToPlan(Playback& playback, Time at) {
  while (playback.nextStamp()) {
    const Playback::Step step = playback.step();
    if (step.outcome.views_inserted > 0 && step.log_stamp >= at) return step.log_stamp;
  }
  throw std::runtime_error(
      fmt::format("--why: no plan is made {:.3f} s into the log or later: it is {:.3f} s long, and "
                  "a plan is made whenever a depth frame enters the history",
                  toSeconds(at - playback.logStart()), toSeconds(playback.logEnd() - playback.logStart())));
}

void requireCandidate(const Explanation& explanation, std::uint32_t index) {
  const auto& all = explanation.candidates;
  if (std::any_of(all.begin(), all.end(), [&](const auto& c) { return c.proposal.index == index; })) return;
  throw std::runtime_error(all.empty() ? "--candidate: this plan considered none: " +
                                             std::string(toString(explanation.decision.reason))
                                       : fmt::format("--candidate {}: this plan considered {} .. {}", index,
                                                     all.front().proposal.index, all.back().proposal.index));
}

}  // namespace

std::string why(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                const WhyQuestion& question) {
  Playback playback(log, configuration, options.span);
  const Time log_stamp = runToPlan(playback, playback.logStart() + question.at);
  Moment moment;
  takeMoment(playback.pipeline(), options.goal, moment);
  const Explanation explanation =
      Planner(configuration.planner).explain(moment.snapshot, moment.state, moment.goal, moment.snapshot.stamp);
  if (question.candidate) requireCandidate(explanation, *question.candidate);

  Text text;
  text.line("plan made {:.3f} s into the log", toSeconds(log_stamp - playback.logStart()));
  writeExplanation(text, explanation, moment, question.candidate);
  return text.take();
}

}  // namespace nanomap
