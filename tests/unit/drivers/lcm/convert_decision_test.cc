#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

goal_t goalMessage() {
  goal_t message{};
  message.utime = 1'999'999;
  message.sequence = 7;
  message.epoch = 2;
  message.position[0] = 1.0;
  message.position[2] = 3.0;
  message.top_speed = 4.0;
  return message;
}

TEST(ToGoal, EveryValueArrives) {
  const Goal goal = std::get<Goal>(toGoal(goalMessage()));
  EXPECT_EQ(goal.stamp, timeFromNanoseconds(1'999'999'000));
  EXPECT_EQ(goal.sequence, 7U);
  EXPECT_EQ(goal.epoch, 2U);
  EXPECT_EQ(goal.position_W_m, Vec3(1.0, 0.0, 3.0));
  EXPECT_EQ(goal.top_speed_m_s, 4.0);
}

TEST(ToGoal, NegativeHeaderFieldsAreNamed) {
  goal_t message = goalMessage();
  message.utime = -1;
  EXPECT_EQ(std::get<ConvertFault>(toGoal(message)), ConvertFault::kBadStamp);
  message = goalMessage();
  message.sequence = -1;
  EXPECT_EQ(std::get<ConvertFault>(toGoal(message)), ConvertFault::kBadSequence);
  message = goalMessage();
  message.epoch = -1;
  EXPECT_EQ(std::get<ConvertFault>(toGoal(message)), ConvertFault::kBadEpoch);
}

TEST(ToGoal, NonFinitePassesThrough) {
  goal_t message = goalMessage();
  message.position[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(std::get<Goal>(toGoal(message)).position_W_m.y()));
}

Decision decisionOf() {
  Decision decision;
  decision.stamp = Time(milliseconds(1234));
  decision.consumed = {2, 11, 12, 13U, 14U, 15, 16U};
  decision.reason = Reason::kFlying;
  decision.candidate = 125;
  decision.trajectory = Trajectory(decision.stamp, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  decision.trajectory.append(0.2, {1, 0, -1});
  decision.trajectory.append(0.8, Vec3::Zero());
  decision.brake = decision.trajectory.firstPart(0.2);
  decision.brake_verified = true;
  decision.risk = 1e-4;
  decision.brake_risk = 1e-5;
  decision.yaw_W_rad = 0.5;
  decision.yaw_rate_rad_s = -0.25;
  decision.candidates = 127;
  decision.evaluated = 20;
  decision.feasible = 5;
  decision.vetoes.by_status[static_cast<std::size_t>(Status::kHole)] = 3;
  decision.vetoes.by_neighbours = 12;
  decision.vetoes.of_brakes = 4;
  return decision;
}

TEST(DecisionMessage, EveryValueArrives) {
  const decision_t message = toMessage(decisionOf(), {.sequence = 99, .step = 1234, .flown = false});
  EXPECT_EQ(message.utime, 1'234'000);
  EXPECT_EQ(message.sequence, 99);
  EXPECT_EQ(message.step, 1234);
  EXPECT_FALSE(message.flown);
  EXPECT_EQ(message.epoch, 2);
  EXPECT_EQ(message.state_sequence, 11);
  EXPECT_EQ(message.pose_sequence, 12);
  EXPECT_TRUE(message.has_correction);
  EXPECT_EQ(message.correction_sequence, 13);
  EXPECT_TRUE(message.has_view);
  EXPECT_EQ(message.newest_view_sequence, 14);
  EXPECT_EQ(message.num_views, 15);
  EXPECT_TRUE(message.has_goal);
  EXPECT_EQ(message.goal_sequence, 16);
  EXPECT_EQ(message.reason, "flying");
  EXPECT_TRUE(message.has_motion);
  EXPECT_EQ(message.primitive, 125);
  EXPECT_EQ(message.risk, 1e-4);
  EXPECT_TRUE(message.has_brake);
  EXPECT_EQ(message.brake_risk, 1e-5);
  EXPECT_EQ(message.yaw, 0.5);
  EXPECT_EQ(message.yaw_rate, -0.25);
  EXPECT_EQ(message.num_candidates, 127);
  EXPECT_EQ(message.num_evaluated, 20);
  EXPECT_EQ(message.num_feasible, 5);
  EXPECT_THAT(message.vetoes, ElementsAre(0, 0, 0, 3, 0, 0, 0, 0, 0));
  EXPECT_EQ(message.vetoes_neighbours, 12);
  EXPECT_EQ(message.vetoes_of_brakes, 4);
}

TEST(DecisionMessage, TrajectoryIsItsStartAndPieces) {
  const trajectory_t trajectory = toMessage(decisionOf(), {}).trajectory;
  EXPECT_EQ(trajectory.utime, 1'234'000);
  EXPECT_THAT(trajectory.position, ElementsAre(1, 2, 3));
  EXPECT_THAT(trajectory.velocity, ElementsAre(4, 5, 6));
  EXPECT_THAT(trajectory.acceleration, ElementsAre(7, 8, 9));
  EXPECT_EQ(trajectory.num_pieces, 2);
  EXPECT_THAT(trajectory.piece_duration, ElementsAre(0.2, 0.8));
  EXPECT_THAT(trajectory.piece_jerk, ElementsAre(ElementsAre(1, 0, -1), ElementsAre(0, 0, 0)));
}

TEST(DecisionMessage, WhatWasNotConsumedOrChosenIsFlagged) {
  const decision_t message = toMessage(Decision{}, {});
  EXPECT_EQ(message.step, 0);
  EXPECT_TRUE(message.flown);
  EXPECT_FALSE(message.has_view);
  EXPECT_FALSE(message.has_correction);
  EXPECT_FALSE(message.has_goal);
  EXPECT_FALSE(message.has_motion);
  EXPECT_FALSE(message.has_brake);
  EXPECT_EQ(message.trajectory.num_pieces, 0);
}

}  // namespace
}  // namespace nanomap
