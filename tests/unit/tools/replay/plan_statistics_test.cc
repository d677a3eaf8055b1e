#include "tools/replay/plan_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/replay/plan_summary.h"

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Decision flying(double risk, bool brake_verified) {
  Decision decision;
  decision.reason = Reason::kFlying;
  decision.risk = risk;
  decision.brake_verified = brake_verified;
  decision.candidates = 127;
  decision.evaluated = 10;
  decision.feasible = 4;
  decision.vetoes.by_status[static_cast<std::size_t>(Status::kHole)] = 2;
  decision.vetoes.by_neighbours = 4;
  decision.vetoes.of_brakes = 3;
  return decision;
}

std::string summaryOf(const PlanStatistics& plans) {
  Text text;
  writePlans(text, plans);
  return text.take();
}

TEST(PlanStatistics, SumsWhatDecisionsSay) {
  PlanStatistics plans;
  plans.record(flying(1e-4, true));
  plans.record(flying(2e-4, false));
  plans.record(Decision{});
  EXPECT_EQ(plans.total(), 3U);
  EXPECT_EQ(plans.because(Reason::kFlying), 2U);
  EXPECT_EQ(plans.because(Reason::kStateInvalid), 1U);
  EXPECT_EQ(plans.candidates(), 254U);
  EXPECT_EQ(plans.evaluated(), 20U);
  EXPECT_EQ(plans.feasible(), 8U);
  EXPECT_EQ(plans.vetoedBy(Status::kHole), 4U);
  EXPECT_EQ(plans.vetoedBy(Status::kOccluded), 0U);
  EXPECT_EQ(plans.vetoedByNeighbours(), 8U);
  EXPECT_EQ(plans.vetoesOfBrakes(), 6U);
  EXPECT_THAT(plans.flownRisks(), ElementsAre(1e-4, 2e-4));
  EXPECT_EQ(plans.flownWithoutBrake(), 1U);
}

TEST(PlanSummary, SharesAreOfTheirWhole) {
  PlanStatistics plans;
  plans.record(flying(1e-4, true));
  plans.record(flying(5e-4, true));
  plans.record(flying(2e-4, true));
  plans.record(Decision{});
  const std::string text = summaryOf(plans);
  EXPECT_THAT(text, HasSubstr("75.00%         3  flying"));
  EXPECT_THAT(text, HasSubstr("p50 0.0002, max 0.0005; 0 without a verified brake"));
  EXPECT_THAT(text, HasSubstr("vetoes: 18, by what weighed most; 50.00% of them because of the brake"));
  EXPECT_THAT(text, HasSubstr("33.33%  hole"));
  EXPECT_THAT(text, HasSubstr("66.67%  measured points too near"));
  EXPECT_THAT(text, Not(HasSubstr("occluded")));
}

TEST(PlanSummary, NothingDecidedIsSaidInOneLine) {
  EXPECT_EQ(summaryOf(PlanStatistics{}),
            "decisions: 0; 0 candidates, of which 0.00% were evaluated and 0.00% found feasible\n");
}

}  // namespace
}  // namespace nanomap
