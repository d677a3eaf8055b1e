#include "tools/replay/explanation_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "planner/planner.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A vehicle at rest, that sees a wall 8 m ahead and is to fly 3 m.
Moment beforeAWall() {
  const auto camera = test::model(test::smallCamera());
  DepthImage image = test::flatImage(*camera, 8000);
  image.sequence = 42;
  const Pose T_C_B = camera->parameters().T_B_C.inverse();
  Moment moment;
  moment.snapshot.T_W_B.translation_m.z() = 2.0;
  moment.snapshot.views.push_back(
      {test::viewOf(image, camera), T_C_B.rotation.toRotationMatrix(), T_C_B.translation_m, Mat3::Zero()});
  moment.state.T_W_B = moment.snapshot.T_W_B;
  moment.goal.emplace();
  moment.goal->position_W_m = {3.0, 0.0, 2.0};
  moment.goal->top_speed_m_s = 2.0;
  return moment;
}

std::string explained(const Moment& moment, std::optional<std::uint32_t> candidate = {}) {
  const Explanation explanation =
      Planner({}).explain(moment.snapshot, moment.state, moment.goal, moment.snapshot.stamp);
  Text text;
  writeExplanation(text, explanation, moment, candidate);
  return text.take();
}

std::size_t linesWith(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ExplanationText, TellsTheDecisionAndMarksTheChosenCandidate) {
  const std::string text = explained(beforeAWall());
  EXPECT_THAT(text, HasSubstr("decision: flying"));
  EXPECT_THAT(text, HasSubstr("brake verified"));
  EXPECT_THAT(text, HasSubstr("newest 42"));
  EXPECT_EQ(linesWith(text, "\n> "), 1U);
}

TEST(ExplanationText, ListsEveryCandidateAndWhatRefusedIt) {
  const std::string text = explained(beforeAWall());
  for (std::uint32_t index = 0; index < kCandidateCount; ++index) {
    EXPECT_THAT(text, HasSubstr(fmt::format(" {:>9}  ", index)));
  }
  EXPECT_THAT(text, HasSubstr("outside fov, worst after"));
}

TEST(ExplanationText, NamesTheBrakeInForce) {
  const Moment moment = beforeAWall();
  Trajectory in_force(moment.snapshot.stamp, {moment.state.T_W_B.translation_m, Vec3::Zero(), Vec3::Zero()});
  in_force.append(0.1, Vec3::Zero());
  const Explanation explanation =
      Planner({}).explain(moment.snapshot, moment.state, moment.goal, moment.snapshot.stamp, {.rest = &in_force});
  Text text;
  writeExplanation(text, explanation, moment, kBrakeInForce);
  const std::string told = text.take();
  EXPECT_THAT(told, HasSubstr("motion of candidate 127 brake in force"));
  EXPECT_EQ(linesWith(told, "brake in force"), 2U);
}

TEST(ExplanationText, ShowsTheViewThatAnsweredForEachSample) {
  const std::string text = explained(beforeAWall(), kGoalDirected);
  EXPECT_THAT(text, HasSubstr("motion of candidate 125 goal-directed"));
  EXPECT_THAT(text, HasSubstr("brake of candidate 125"));
  const std::regex answered_by_the_view(" 0 +42 ");
  EXPECT_GE(std::distance(std::sregex_iterator(text.begin(), text.end(), answered_by_the_view), {}), 30)
      << "20 steps and 10 of the brake";
}

TEST(ExplanationText, AskedForCandidateIsShownInsteadOfTheChosenOne) {
  EXPECT_THAT(explained(beforeAWall(), 60), HasSubstr("motion of candidate 60"));
}

TEST(ExplanationText, StateThatAllowsNothingHasNoTables) {
  Moment moment = beforeAWall();
  moment.state.velocity_W_m_s.x() = std::numeric_limits<double>::quiet_NaN();
  const std::string text = explained(moment);
  EXPECT_THAT(text, HasSubstr("the vehicle's state is invalid"));
  EXPECT_THAT(text, Not(HasSubstr("candidate ")));
}

TEST(ExplanationText, WithoutAGoalTheBrakeIsTheOnlyCandidate) {
  Moment moment = beforeAWall();
  moment.goal.reset();
  const std::string text = explained(moment);
  EXPECT_THAT(text, HasSubstr("no goal"));
  EXPECT_THAT(text, HasSubstr("> " + fmt::format("{:>9}", kBrake)));
  EXPECT_THAT(text, HasSubstr("1 candidates"));
}

}  // namespace
}  // namespace nanomap
