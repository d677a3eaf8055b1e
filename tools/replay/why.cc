#include "tools/replay/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "planner/receding_horizon.h"
#include "tools/replay/explanation_text.h"
#include "tools/replay/moment.h"
#include "tools/replay/playback.h"

namespace nanomap {
namespace {

/// Plans on until the plan that is asked about is due: each starts from the one before.
/// @return its log time; `moment` is what it is made of
Time runToPlan(Playback& playback, const std::optional<Goal>& other_goal, Time at, RecedingHorizon& horizon,
               Moment& moment) {
  while (playback.nextStamp()) {
    for (const PlanPoint& plan : playback.advance().plans) {
      takeMoment(playback.pipeline(), plan.now, other_goal, moment);
      if (!plan.place.flown) horizon.release();
      if (plan.log_stamp >= at) return plan.log_stamp;
      (void)horizon.step(moment.snapshot, moment.state, moment.goal, moment.now);
    }
  }
  throw std::runtime_error(
      fmt::format("--why: no plan is made {:.3f} s into the log or later: it is {:.3f} s long, and a plan is made "
                  "where the flight made one or, without its steps, whenever a depth frame enters the history",
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
  const auto playback = makePlayback(log, configuration, options.span);
  RecedingHorizon horizon(configuration.planner);
  Moment moment;
  const Time log_stamp = runToPlan(*playback, options.goal, playback->logStart() + question.at, horizon, moment);
  const Explanation explanation = horizon.explain(moment.snapshot, moment.state, moment.goal, moment.now);
  if (question.candidate) requireCandidate(explanation, *question.candidate);

  Text text;
  text.line("plan made {:.3f} s into the log", toSeconds(log_stamp - playback->logStart()));
  writeExplanation(text, explanation, moment, question.candidate);
  return text.take();
}

}  // namespace nanomap
