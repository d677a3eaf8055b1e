#include "firmware_app/pipeline/epoch_assigner.h"

#include <gtest/gtest.h>

#include <limits>

namespace nanomap {
namespace {

constexpr double kMaxSpeed_m_s = 20.0;

Time at(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }
Pose placed(double x_m) { return {Quat::Identity(), {x_m, 0.0, 0.0}}; }

TEST(EpochAssigner, FlightBelowTheLimitStaysInOneEpoch) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(epochs.assign(at(10 * i), placed(0.19 * i)), 0U);
}

TEST(EpochAssigner, JumpStartsAnEpochThatStays) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(10), placed(5.0)), 1U);
  EXPECT_EQ(epochs.assign(at(20), placed(5.1)), 1U);
  EXPECT_EQ(epochs.assign(at(30), placed(0.0)), 2U);
}

TEST(EpochAssigner, LongGapAllowsALongStep) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(1000), placed(19.0)), 0U);
  EXPECT_EQ(epochs.assign(at(2000), placed(40.0)), 1U);
}

TEST(EpochAssigner, NoiseBetweenPosesStampedAlmostTogetherIsNoJump) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(Time(std::chrono::microseconds(0)), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(Time(std::chrono::microseconds(1)), placed(0.02)), 0U);
}

TEST(EpochAssigner, DuplicateChangesNothing) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(0), placed(50.0)), 0U);
  EXPECT_EQ(epochs.assign(at(10), placed(0.1)), 0U);
}

TEST(EpochAssigner, LatePoseJoinsTheWorldItCanBeReachedFrom) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(20), placed(100.0)), 1U);
  EXPECT_EQ(epochs.assign(at(10), placed(0.1)), 0U);
  EXPECT_EQ(epochs.assign(at(15), placed(100.0)), 1U);
  EXPECT_EQ(epochs.assign(at(30), placed(100.1)), 1U);
}

TEST(EpochAssigner, JumpThatTheSenderTellsIsNotCountedTwice) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0), 3), 3U);
  EXPECT_EQ(epochs.assign(at(10), placed(50.0), 4), 4U);
  EXPECT_EQ(epochs.assign(at(20), placed(50.1), 4), 4U);
}

TEST(EpochAssigner, JumpThatTheSenderHidesRaisesAllThatFollows) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0), 3), 3U);
  EXPECT_EQ(epochs.epochOf(3), 3U);
  EXPECT_EQ(epochs.assign(at(10), placed(1.0), 3), 4U);
  EXPECT_EQ(epochs.epochOf(3), 4U);
  EXPECT_EQ(epochs.assign(at(20), placed(1.0), 4), 5U);
}

TEST(EpochAssigner, LatePoseOfAnOlderSentEpochChangesNothing) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(10), placed(0.0), 3), 3U);
  EXPECT_EQ(epochs.assign(at(20), placed(50.0), 4), 4U);
  EXPECT_EQ(epochs.assign(at(15), placed(0.0), 3), 3U);
  EXPECT_EQ(epochs.assign(at(30), placed(50.0), 4), 4U);
}

TEST(EpochAssigner, SenderThatStartsAnewIsInTheNextEpoch) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0), 3), 3U);
  EXPECT_EQ(epochs.assign(at(1000), placed(0.0), 0), 4U);
  EXPECT_EQ(epochs.epochOf(0), 4U);
  EXPECT_EQ(epochs.assign(at(1010), placed(0.1), 0), 4U);
  EXPECT_EQ(epochs.assign(at(1020), placed(50.0), 1), 5U);
}

TEST(EpochAssigner, PoseThatIsNotFiniteChangesNothing) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(10), placed(std::numeric_limits<double>::quiet_NaN())), 0U);
  EXPECT_EQ(epochs.assign(at(20), placed(std::numeric_limits<double>::infinity())), 0U);
  EXPECT_EQ(epochs.assign(at(30), placed(0.3)), 0U);
}

TEST(EpochAssigner, JumpIsSeenAfterAPoseOfAnotherClock) {
  EpochAssigner epochs(kMaxSpeed_m_s);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(3'600'000), placed(0.1)), 0U);
  EXPECT_EQ(epochs.assign(at(10), placed(0.2)), 0U);
  EXPECT_EQ(epochs.assign(at(20), placed(5.0)), 1U);
}

TEST(EpochAssigner, ZeroSwitchesItOff) {
  EpochAssigner epochs(0.0);
  EXPECT_EQ(epochs.assign(at(0), placed(0.0)), 0U);
  EXPECT_EQ(epochs.assign(at(10), placed(1000.0)), 0U);
}

}  // namespace
}  // namespace nanomap
