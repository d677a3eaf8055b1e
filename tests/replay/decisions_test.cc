#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/replay/replaying.h"
#include "tools/replay/decision_diff.h"
#include "tools/replay/decision_log.h"
#include "tools/replay/why.h"

namespace nanomap::test {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kStateInvalid = "the vehicle's state is invalid: keep to the last verified brake";

/// Eleven frames of a flight at 1 m/s towards a wall 8 m ahead, without velocities in its poses, with a goal at 5 m.
std::filesystem::path goalFlight() {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.goal(0);
  log.fly(0, 1000);
  return log.close();
}

/// Such that the flight's floor-less world at height 0 is in the band.
Configuration configuration() {
  Configuration configuration;
  configuration.planner.objective.min_altitude_W_m = -10.0;
  return configuration;
}

std::vector<decision_t> decided(const std::filesystem::path& flight, const std::string& name,
                                const Configuration& changed = configuration(), const ReplayOptions& options = {}) {
  return readDecisions({decisionsOf(flight, name, changed, options)});
}

TEST(ReplayDecisions, OneIsMadeForEveryFrame) {
  const auto decisions = decided(goalFlight(), "decisions");
  ASSERT_EQ(decisions.size(), 11U);
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    EXPECT_EQ(decisions[i].sequence, static_cast<std::int64_t>(i));
    EXPECT_EQ(decisions[i].utime, static_cast<std::int64_t>(100'000 * i));
    EXPECT_EQ(decisions[i].state_sequence, decisions[i].pose_sequence);
    EXPECT_EQ(decisions[i].newest_view_sequence, static_cast<std::int64_t>(100 * i));
    EXPECT_TRUE(decisions[i].has_goal);
  }
  EXPECT_EQ(decisions[0].reason, kStateInvalid) << "no earlier poses to take a velocity from";
  EXPECT_EQ(decisions.back().reason, "flying");
  EXPECT_NEAR(decisions[1].trajectory.velocity[0], FlightLog::kSpeed_m_s, 1e-9) << "as measured: nothing is in force";
  EXPECT_GT(decisions.back().trajectory.velocity[0], FlightLog::kSpeed_m_s) << "taken to follow what was decided";
  EXPECT_LE(decisions.back().risk, configuration().planner.risk.max_risk);
  EXPECT_TRUE(decisions.back().has_brake);
}

TEST(ReplayDecisions, TwoRunsWriteTheSameBytes) {
  const auto flight = goalFlight();
  const std::string first = bytesOf(decisionsOf(flight, "first"));
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytesOf(decisionsOf(flight, "second")));
}

TEST(ReplayDecisions, WithoutAGoalTheVehicleStands) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, 500);
  const auto decisions = decided(log.close(), "decisions");
  EXPECT_EQ(decisions.back().reason, toString(Reason::kNoGoal));
  EXPECT_FALSE(decisions.back().has_goal);
}

TEST(ReplayDecisions, GoalFromBeforeTheSpanHolds) {
  ReplayOptions options;
  options.span.from = std::chrono::milliseconds(500);
  EXPECT_TRUE(decided(goalFlight(), "decisions", configuration(), options).back().has_goal);
}

TEST(ReplayDecisions, GivenGoalWinsAndIsOfTheVehiclesOwnWorld) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.goal(0);
  for (std::int64_t ms = 0; ms <= 500; ms += 10) {
    log.pose(ms, [](BodyPose& pose) { pose.epoch = 4; });
    if (ms % 100 == 0) log.depth(ms);
  }
  const auto flight = log.close();
  EXPECT_EQ(decided(flight, "log's").back().reason, toString(Reason::kGoalOtherEpoch));
  ReplayOptions options;
  options.goal.emplace();
  options.goal->position_W_m = {5.0, 0.0, 0.0};
  options.goal->top_speed_m_s = 2.0;
  EXPECT_EQ(decided(flight, "given", configuration(), options).back().reason, "flying");
}

TEST(ReplayDecisions, EarlyExitChangesWorkOnly) {
  const auto flight = goalFlight();
  Configuration exhaustive = configuration();
  exhaustive.planner.early_exit = false;
  const DecisionDiff diff = compareDecisions(decided(flight, "early"), decided(flight, "exhaustive", exhaustive));
  for (const FieldDifference& field : diff.fields) {
    EXPECT_TRUE(field.field.starts_with("vetoes") || field.field == "num_evaluated" || field.field == "num_feasible")
        << field.field << ": " << field.first_a << " | " << field.first_b;
  }
}

TEST(ReplayDecisions, AnotherConfigurationIsFoundByTheDiff) {
  const auto flight = goalFlight();
  Configuration paper = configuration();
  paper.planner.stop_check = StopCheck::kPaper;
  const DecisionDiff diff = compareDecisions(decided(flight, "verified"), decided(flight, "paper", paper));
  EXPECT_EQ(diff.different, 10U) << "all but the one without a velocity";
  EXPECT_EQ(diff.first_utime, 100'000);
}

TEST(ReplayDecisions, SummaryCountsThem) {
  const ReplayReport report = replayed(goalFlight(), configuration());
  EXPECT_EQ(report.plans.total(), 11U);
  EXPECT_EQ(report.plan_times.size(), 11U);
  EXPECT_EQ(report.plans.because(Reason::kStateInvalid), 1U);
}

TEST(ReadDecisions, LogWithoutOneIsNamed) {
  const auto flight = goalFlight();
  try {
    (void)readDecisions({flight});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(flight.string()));
  }
}

TEST(Why, ExplainsTheFirstPlanFromThatTimeOn) {
  LogReader log(goalFlight());
  const std::string text = why(log, configuration(), {}, {.at = std::chrono::milliseconds(350)});
  EXPECT_THAT(text, HasSubstr("plan made 0.400 s into the log"));
  EXPECT_THAT(text, HasSubstr("newest 400"));
}

TEST(Why, TimeOrCandidateThatIsNotThereIsExplained) {
  LogReader log(goalFlight());
  const auto refusal = [&log](const WhyQuestion& question) -> std::string {
    try {
      return why(log, configuration(), {}, question);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal({.at = std::chrono::seconds(5)}), HasSubstr("no plan is made 5.000 s into the log or later"));
  EXPECT_THAT(refusal({.at = std::chrono::milliseconds(500), .candidate = 128}), HasSubstr("considered 0 .. 127"));
  EXPECT_THAT(refusal({.at = Duration{}, .candidate = 3}), HasSubstr("considered none"));
}

}  // namespace
}  // namespace nanomap::test
