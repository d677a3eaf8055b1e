#include "tools/replay/plan_summary.h"

#include "tools/replay/percentile.h"

namespace nanomap {
namespace {

void writeVetoes(Text& text, const PlanStatistics& plans) {
  const std::uint64_t vetoed = plans.evaluated() - plans.feasible();
  if (vetoed == 0) return;
  text.line("vetoes: {}, by what weighed most; {:.2f}% of them because of the brake", vetoed,
            share(plans.vetoesOfBrakes(), vetoed));
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    const auto status = static_cast<Status>(i);
    if (plans.vetoedBy(status) > 0)
      text.line("  {:>8.2f}%  {}", share(plans.vetoedBy(status), vetoed), toString(status));
  }
  if (plans.vetoedByNeighbours() > 0) {
    text.line("  {:>8.2f}%  measured points too near", share(plans.vetoedByNeighbours(), vetoed));
  }
}

}  // namespace

void writePlans(Text& text, const PlanStatistics& plans) {
  text.line("decisions: {}; {} candidates, of which {:.2f}% were evaluated and {:.2f}% found feasible", plans.total(),
            plans.candidates(), share(plans.evaluated(), plans.candidates()),
            share(plans.feasible(), plans.candidates()));
  for (std::size_t i = 0; i < kReasonCount; ++i) {
    const auto reason = static_cast<Reason>(i);
    const std::uint64_t count = plans.because(reason);
    if (count > 0) text.line("  {:>8.2f}%  {:>8}  {}", share(count, plans.total()), count, toString(reason));
  }
  if (!plans.flownRisks().empty()) {
    text.line("risk of the motions flown: p50 {:.2g}, max {:.2g}; {} without a verified brake",
              percentile(plans.flownRisks(), 0.5), percentile(plans.flownRisks(), 1.0), plans.flownWithoutBrake());
  }
  writeVetoes(text, plans);
}

}  // namespace nanomap
