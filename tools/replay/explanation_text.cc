#include "tools/replay/explanation_text.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace nanomap {
namespace {

std::string vectorText(const Vec3& v) { return fmt::format("{:8.2f}{:8.2f}{:8.2f}", v.x(), v.y(), v.z()); }

std::string_view nameOf(std::uint32_t index) {
  if (index == kGoalDirected) return "goal-directed";
  if (index == kBrake) return "brake";
  return index == kBrakeInForce ? "brake in force" : "";
}

/// What refused the candidate, and where; empty if nothing did.
std::string vetoText(const CandidateExplanation& candidate) {
  const Verdict& verdict = candidate.verdict;
  if (!verdict.veto) return "";
  const std::string_view cause = verdict.veto->status ? toString(*verdict.veto->status) : "measured points too near";
  const bool by_brake = verdict.vetoedByBrake();
  const auto& samples = by_brake ? candidate.evidence.brake : candidate.evidence.motion;
  const auto worst =
      std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.risk < b.risk; });
  const std::string where = worst == samples.end() ? "" : fmt::format(", worst after {:.2f} s", worst->elapsed_s);
  return fmt::format("{}{}{}", by_brake ? "brake: " : "", cause, where);
}

void writeDecision(Text& text, const Decision& decision, const Moment& moment) {
  const Consumed& consumed = decision.consumed;
  text.line("decision: {}", toString(decision.reason));
  text.line("  consumed: state {}, pose {}, epoch {}, {} views{}{}{}", consumed.state_sequence, consumed.pose_sequence,
            consumed.epoch, consumed.view_count,
            consumed.newest_view_sequence ? fmt::format(", newest {}", *consumed.newest_view_sequence) : "",
            consumed.correction_sequence ? fmt::format(", correction {}", *consumed.correction_sequence) : "",
            consumed.goal_sequence ? fmt::format(", goal {}", *consumed.goal_sequence) : ", no goal");
  text.line("  position [m, W]    {}", vectorText(moment.state.T_W_B.translation_m));
  text.line("  velocity [m/s, W]  {}", vectorText(moment.state.velocity_W_m_s));
  if (moment.goal) {
    text.line("  goal [m, W]        {}  up to {:.2f} m/s", vectorText(moment.goal->position_W_m),
              moment.goal->top_speed_m_s);
  }
  if (!decision.candidate) return;
  text.line("  chosen: {} {}, risk {:.3g}; {}; turns to {:.2f} rad at {:.2f} rad/s", *decision.candidate,
            nameOf(*decision.candidate), decision.risk,
            decision.brake_verified ? fmt::format("brake verified, risk {:.3g}", decision.brake_risk)
                                    : "its brake is not verified",
            decision.yaw_W_rad, decision.yaw_rate_rad_s);
  text.line("  {} candidates, {} evaluated, {} of them feasible", decision.candidates, decision.evaluated,
            decision.feasible);
}

void writeCandidates(Text& text, const Explanation& explanation) {
  std::vector<const CandidateExplanation*> ordered;
  for (const CandidateExplanation& candidate : explanation.candidates) ordered.push_back(&candidate);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto* a, const auto* b) { return a->objective > b->objective; });
  text.line("");
  text.line("  {:>9}  {:>24}{:>11}{:>11}{:>11}{:>11}  {:<15}{}", "candidate", "acceleration [m/s^2, L]", "reward",
            "objective", "risk", "brake risk", "", "veto");
  for (const CandidateExplanation* candidate : ordered) {
    const std::uint32_t index = candidate->proposal.index;
    const std::string stop =
        candidate->verdict.stop ? fmt::format("{:.2g}", candidate->verdict.stop->risk) : std::string("-");
    text.line("{} {:>9}  {}{:>11.2f}{:>11.2f}{:>11.2g}{:>11}  {:<15}{}",
              explanation.decision.candidate == index ? '>' : ' ', index, vectorText(candidate->acceleration_L_m_s2),
              candidate->proposal.reward, candidate->objective, candidate->verdict.motion.risk, stop, nameOf(index),
              vetoText(*candidate));
  }
}

/// Below the sample's own line, in the same columns.
void writeSecondLook(Text& text, std::string_view name, const SecondLook& look, const ChainSnapshot& snapshot) {
  if (!look.view_index) return;
  text.line("  {:>7}  {:>24}    {:<11}{:>10}{:>10}{:>12}{:>10}{:>10.2g}", "", "", name, *look.view_index,
            snapshot.views[*look.view_index].view->sequence(),
            look.nearest_m ? fmt::format("{:.2f}", *look.nearest_m) : "-", "", look.collision_probability);
}

void writeSamples(Text& text, std::string_view title, const std::vector<SampleEvidence>& samples,
                  const ChainSnapshot& snapshot) {
  if (samples.empty()) return;
  text.line("");
  text.line("  {}", title);
  text.line("  {:>7}  {:>24}  {:<13}{:>10}{:>10}{:>12}{:>10}{:>10}{:>10}", "time s", "position [m, W]", "status",
            "views back", "sequence", "nearest m", "prior", "p", "risk");
  for (const SampleEvidence& sample : samples) {
    const std::string back = sample.view_index ? std::to_string(*sample.view_index) : "-";
    const std::string sequence =
        sample.view_index ? std::to_string(snapshot.views[*sample.view_index].view->sequence()) : "-";
    const std::string nearest = sample.nearest_m ? fmt::format("{:.2f}", *sample.nearest_m) : "-";
    text.line("  {:>7.3f}  {}  {:<13}{:>10}{:>10}{:>12}{:>10.2g}{:>10.2g}{:>10.2g}{}", sample.elapsed_s,
              vectorText(sample.position_W_m), toString(sample.status), back, sequence, nearest, sample.prior,
              sample.collision_probability, sample.risk, sample.in_bubble ? "  in the bubble" : "");
    writeSecondLook(text, "newer", sample.newer, snapshot);
    writeSecondLook(text, "beside", sample.beside, snapshot);
    if (sample.beside.asked && !sample.beside.view_index) {
      text.line("  {:>7}  {:>24}    {:<11}{:>10}", "", "", "beside", "unseen");
    }
  }
}

}  // namespace

void writeExplanation(Text& text, const Explanation& explanation, const Moment& moment,
                      std::optional<std::uint32_t> candidate) {
  writeDecision(text, explanation.decision, moment);
  if (explanation.candidates.empty()) return;
  writeCandidates(text, explanation);

  const std::uint32_t shown = candidate.value_or(*explanation.decision.candidate);
  const auto found = std::find_if(explanation.candidates.begin(), explanation.candidates.end(),
                                  [shown](const auto& c) { return c.proposal.index == shown; });
  if (found == explanation.candidates.end()) return;
  writeSamples(text, fmt::format("motion of candidate {} {}", shown, nameOf(shown)), found->evidence.motion,
               moment.snapshot);
  writeSamples(text, fmt::format("brake of candidate {}", shown), found->evidence.brake, moment.snapshot);
}

}  // namespace nanomap
