#include "firmware_app/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace nanomap {
namespace {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, message.getEncodedSize()), message.getEncodedSize());
  return bytes;
}

class PipelineOutputs : public ::testing::Test {
 protected:
  void feedPose(std::int64_t ms, double x_m, double velocity_m_s) {
    BodyPose pose;
    pose.stamp = Time(std::chrono::milliseconds(ms));
    pose.sequence = static_cast<std::uint64_t>(ms);
    pose.T_W_B.translation_m.x() = x_m;
    pipeline_.feed(InputKind::kPose, encoded(toMessage(pose, BodyMotion{.velocity_W_m_s = {velocity_m_s, 0.0, 0.0}})));
  }

  void feedGoal(std::int64_t sequence) {
    goal_t goal{};
    goal.sequence = sequence;
    pipeline_.feed(InputKind::kGoal, encoded(goal));
  }

  Pipeline pipeline_{Configuration{}};
};

TEST_F(PipelineOutputs, ThereIsNoStateAndNoGoalAtFirst) {
  EXPECT_FALSE(pipeline_.state());
  EXPECT_FALSE(pipeline_.goal());
}

TEST_F(PipelineOutputs, StateIsThatOfTheNewestPose) {
  feedPose(1990, 1.0, 1.0);
  feedPose(2010, 2.0, 2.0);
  feedPose(2000, 3.0, 3.0);
  ASSERT_TRUE(pipeline_.state());
  EXPECT_EQ(pipeline_.state()->sequence, 2010U) << "a late pose is no newer state";
  EXPECT_EQ(pipeline_.state()->velocity_W_m_s, Vec3(2.0, 0.0, 0.0));
}

TEST_F(PipelineOutputs, PoseThatTheChainRefusesIsNoState) {
  feedPose(1000, 1.0, 1.0);
  feedPose(1010, std::numeric_limits<double>::quiet_NaN(), 1.0);
  EXPECT_EQ(pipeline_.state()->sequence, 1000U);
}

TEST_F(PipelineOutputs, GoalIsTheOneReceivedLast) {
  feedGoal(8);
  feedGoal(3);
  ASSERT_TRUE(pipeline_.goal());
  EXPECT_EQ(pipeline_.goal()->sequence, 3U) << "a sender that restarts counts anew";
}

TEST_F(PipelineOutputs, DamagedGoalIsCountedAndTheLastGoodOneStays) {
  feedGoal(8);
  feedGoal(-1);
  const auto goal_kind = static_cast<std::size_t>(InputKind::kGoal);
  EXPECT_EQ(pipeline_.goal()->sequence, 8U);
  EXPECT_EQ(pipeline_.counters().convert_faults[goal_kind][static_cast<std::size_t>(ConvertFault::kBadSequence)], 1U);
  EXPECT_EQ(pipeline_.counters().messages[goal_kind], 2U);
}

}  // namespace
}  // namespace nanomap
