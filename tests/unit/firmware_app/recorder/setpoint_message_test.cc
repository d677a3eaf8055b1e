#include "firmware_app/recorder/setpoint_message.h"

#include <gmock/gmock.h>

namespace nanomap {
namespace {

using ::testing::ElementsAre;

SentSetpoint setpoint() {
  SentSetpoint setpoint;
  setpoint.stamp = Time(std::chrono::milliseconds(1500));
  setpoint.verdict.state = State::kFlying;
  setpoint.motion.emplace();
  setpoint.motion->motion_W.position_m = {1, 2, 3};
  setpoint.motion->motion_W.velocity_m_s = {4, 5, 6};
  setpoint.motion->motion_W.acceleration_m_s2 = {7, 8, 9};
  setpoint.motion->yaw_W_rad = 0.5;
  setpoint.motion->decision = 42;
  return setpoint;
}

TEST(SetpointMessage, SaysWhatWasToldAndByWhichDecision) {
  const setpoint_t message = toMessage(setpoint());
  EXPECT_EQ(message.utime, 1'500'000);
  EXPECT_EQ(message.state, toString(State::kFlying));
  EXPECT_TRUE(message.has_decision);
  EXPECT_EQ(message.decision_sequence, 42);
  EXPECT_TRUE(message.has_position);
  EXPECT_THAT(message.position, ElementsAre(1, 2, 3));
  EXPECT_THAT(message.velocity, ElementsAre(4, 5, 6));
  EXPECT_THAT(message.acceleration, ElementsAre(7, 8, 9));
  EXPECT_TRUE(message.has_yaw);
  EXPECT_EQ(message.yaw, 0.5);
}

TEST(SetpointMessage, WhatWasNotToldIsFlagged) {
  SentSetpoint velocity_only = setpoint();
  velocity_only.motion->with_position = false;
  velocity_only.motion->decision.reset();
  const setpoint_t message = toMessage(velocity_only);
  EXPECT_FALSE(message.has_decision);
  EXPECT_FALSE(message.has_position);
  EXPECT_THAT(message.position, ElementsAre(0, 0, 0));
  EXPECT_THAT(message.velocity, ElementsAre(4, 5, 6));
}

TEST(StateInWords, NamesWhatIsMissing) {
  SafetyVerdict verdict;
  verdict.state = State::kFlying;
  EXPECT_EQ(stateInWords(verdict), toString(State::kFlying));
  verdict.faults.add(Fault::kDepth);
  EXPECT_EQ(stateInWords(verdict), std::string(toString(State::kFlying)) + ": " + verdict.faults.words());
}

}  // namespace
}  // namespace nanomap
