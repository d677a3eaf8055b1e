#include "tools/replay/decision_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

using ::testing::HasSubstr;

/// Decisions 0.1 s apart, from 2 s on.
std::vector<decision_t> decisions(int count) {
  std::vector<decision_t> all;
  for (int i = 0; i < count; ++i) {
    Decision decision;
    decision.stamp = Time(std::chrono::milliseconds(2000 + 100 * i));
    decision.candidate = 7;
    decision.reason = Reason::kFlying;
    decision.risk = 0.125;
    all.push_back(toMessage(decision, {.sequence = static_cast<std::uint64_t>(i)}));
  }
  return all;
}

TEST(CompareDecisions, NothingIsTheSameAsNothing) { EXPECT_TRUE(compareDecisions({}, {}).same()); }

TEST(CompareDecisions, SameDecisionsAreTheSame) {
  const auto a = decisions(3);
  const DecisionDiff diff = compareDecisions(a, a);
  EXPECT_TRUE(diff.same());
  EXPECT_EQ(diff.in_a, 3U);
  EXPECT_THAT(toText(diff), HasSubstr("all are the same"));
}

TEST(CompareDecisions, NanIsTheSameAsNan) {
  auto a = decisions(1);
  a[0].yaw = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(compareDecisions(a, a).same());
  EXPECT_FALSE(compareDecisions(a, decisions(1)).same());
}

TEST(CompareDecisions, CountOfDecisionsAloneIsNoDifference) {
  auto b = decisions(2);
  b[0].sequence = 99;
  EXPECT_TRUE(compareDecisions(decisions(2), b).same());
}

TEST(CompareDecisions, LastBitOfANumberIsADifference) {
  const auto a = decisions(3);
  auto b = a;
  b[1].risk = std::nextafter(b[1].risk, 1.0);
  const DecisionDiff diff = compareDecisions(a, b);
  EXPECT_EQ(diff.different, 1U);
  EXPECT_EQ(diff.first_utime, 2'100'000);
  ASSERT_EQ(diff.fields.size(), 1U);
  EXPECT_EQ(diff.fields[0].field, "risk");
  EXPECT_EQ(diff.fields[0].first_a, "0.125");
  EXPECT_EQ(diff.fields[0].first_b, "0.12500000000000003");
}

TEST(CompareDecisions, EveryFieldIsCompared) {
  using Change = void (*)(decision_t&);
  const std::vector<std::pair<std::string, Change>> changes = {
      {"step", [](decision_t& d) { d.step = 1; }},
      {"flown", [](decision_t& d) { d.flown = 0; }},
      {"state_sequence", [](decision_t& d) { d.state_sequence = 1; }},
      {"pose_sequence", [](decision_t& d) { d.pose_sequence = 1; }},
      {"epoch", [](decision_t& d) { d.epoch = 1; }},
      {"num_views", [](decision_t& d) { d.num_views = 1; }},
      {"newest_view_sequence", [](decision_t& d) { d.has_view = 1; }},
      {"correction_sequence", [](decision_t& d) { d.has_correction = 1; }},
      {"goal_sequence", [](decision_t& d) { d.has_goal = 1; }},
      {"reason", [](decision_t& d) { d.reason = "other"; }},
      {"primitive", [](decision_t& d) { d.primitive = 8; }},
      {"trajectory",
       [](decision_t& d) {
         d.trajectory.piece_duration = {1.0}, d.trajectory.piece_jerk = {{0, 0, 0}};
       }},
      {"yaw", [](decision_t& d) { d.yaw = 1.0; }},
      {"yaw_rate", [](decision_t& d) { d.yaw_rate = 1.0; }},
      {"risk", [](decision_t& d) { d.risk = 0.5; }},
      {"has_brake", [](decision_t& d) { d.has_brake = 1; }},
      {"brake", [](decision_t& d) { d.brake.velocity[2] = 1.0; }},
      {"brake_risk", [](decision_t& d) { d.brake_risk = 0.5; }},
      {"num_candidates", [](decision_t& d) { d.num_candidates = 1; }},
      {"num_evaluated", [](decision_t& d) { d.num_evaluated = 1; }},
      {"num_feasible", [](decision_t& d) { d.num_feasible = 1; }},
      {"vetoes (hole)", [](decision_t& d) { d.vetoes[static_cast<std::size_t>(Status::kHole)] = 1; }},
      {"vetoes_neighbours", [](decision_t& d) { d.vetoes_neighbours = 1; }},
      {"vetoes_of_brakes", [](decision_t& d) { d.vetoes_of_brakes = 1; }},
  };
  for (const auto& [field, change] : changes) {
    auto b = decisions(1);
    change(b[0]);
    const DecisionDiff diff = compareDecisions(decisions(1), b);
    ASSERT_EQ(diff.fields.size(), 1U) << field;
    EXPECT_EQ(diff.fields[0].field, field);
  }
}

TEST(CompareDecisions, DecisionsOfOneLogOnlyAreCountedAndTheRestStillMatched) {
  auto a = decisions(4);
  auto b = a;
  a.erase(a.begin() + 1);
  b.erase(b.begin() + 2, b.end());
  const DecisionDiff diff = compareDecisions(a, b);
  EXPECT_EQ(diff.only_in_a, 2U);
  EXPECT_EQ(diff.only_in_b, 1U);
  EXPECT_EQ(diff.different, 0U);
  EXPECT_EQ(diff.first_utime, 2'100'000);
  EXPECT_EQ(compareDecisions({}, b).first_utime, 2'000'000);
}

TEST(CompareDecisions, DecisionsForTheSameTimeAreMatchedInTheirOrder) {
  auto a = decisions(2);
  a[1].utime = a[0].utime;
  a[1].risk = 0.5;
  EXPECT_TRUE(compareDecisions(a, a).same());
}

TEST(DecisionDiffText, SaysWhereAndWhyTheyPart) {
  const auto a = decisions(3);
  auto other_choice = a;
  for (decision_t& decision : other_choice) decision.primitive = 9;
  const std::string text = toText(compareDecisions(a, other_choice));
  EXPECT_THAT(text, HasSubstr("they part 0.000 s after the first decision (utime 2000000); 3 of those in both differ"));
  EXPECT_THAT(text, HasSubstr("the same inputs were consumed"));
  EXPECT_THAT(text, HasSubstr("A: 7\n    B: 9\n"));

  auto other_input = other_choice;
  other_input[0].correction_sequence = 4;
  other_input[0].has_correction = 1;
  EXPECT_THAT(toText(compareDecisions(a, other_input)), HasSubstr("other inputs were consumed"));
}

}  // namespace
}  // namespace nanomap
