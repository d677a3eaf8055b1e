#include "firmware_app/stages/ingest.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "drivers/lcm/encode.h"
#include "firmware_app/stages/hand_overs.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;

template <class Message>
std::vector<std::uint8_t> bytesOf(const Message& message) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(encodeInto(message, bytes));
  return bytes;
}

std::vector<std::uint8_t> poseAt(Time stamp) {
  BodyPose pose;
  pose.stamp = stamp;
  return bytesOf(toMessage(pose, std::nullopt));
}

class IngestTest : public ::testing::Test {
 protected:
  std::optional<ArrivedInput> takenInput() {
    std::optional<ArrivedInput> taken;
    hand_overs_.inputs.pop([&](const ArrivedInput& input) { taken = input; });
    return taken;
  }

  Ingest ingestOf(ClockDomain domain, Duration realtime_ahead = {}) {
    return {LcmParameters{},
            StampClock(domain, SafetyParameters().max_stamp_lead, realtime_ahead),
            {hand_overs_.inputs, hand_overs_.chain_bell, hand_overs_.frames, hand_overs_.capture_bell,
             hand_overs_.cameras, hand_overs_.index_bell, hand_overs_.ingest_counters}};
  }

  static constexpr Time kNow = Time(100s);
  HandOvers hand_overs_{1};
};

TEST_F(IngestTest, ArrivalsAreWholeMicrosecondsAndNoTwoAlike) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  EXPECT_EQ(ingest.arrivalAt(kNow + 1999ns), kNow + 1us);
  EXPECT_EQ(ingest.arrivalAt(kNow + 1999ns), kNow + 2us);
  EXPECT_EQ(ingest.arrivalAt(kNow), kNow + 3us) << "a clock that went back";
  EXPECT_EQ(ingest.arrivalAt(kNow + 1s), kNow + 1s);
}

TEST_F(IngestTest, PoseGoesToTheChainWithItsArrival) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  ingest.take(InputKind::kPose, poseAt(kNow - 5ms), kNow);
  const auto input = takenInput();
  ASSERT_TRUE(input);
  EXPECT_EQ(input->arrival, kNow);
  EXPECT_EQ(std::get<PoseInput>(input->input).pose.stamp, kNow - 5ms);
  EXPECT_TRUE(hand_overs_.chain_bell.wait(Duration::zero()));
}

TEST_F(IngestTest, StampsOfTheTimeOfDayAreMovedToOurClock) {
  Ingest ingest = ingestOf(ClockDomain::kRealtime, 1000s);
  ingest.take(InputKind::kPose, poseAt(kNow + 1000s - 5ms), kNow);
  const auto input = takenInput();
  ASSERT_TRUE(input);
  EXPECT_EQ(std::get<PoseInput>(input->input).pose.stamp, kNow - 5ms);
  EXPECT_EQ(input->stamp_shift, -1000s);
}

TEST_F(IngestTest, PoseFarAheadOfOurClockIsKeptOutAndCounted) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  ingest.take(InputKind::kPose, poseAt(kNow + 10s), kNow);
  EXPECT_FALSE(takenInput());
  EXPECT_EQ(ingest.counters().from_future[static_cast<std::size_t>(InputKind::kPose)], 1U);
}

TEST_F(IngestTest, GarbageIsCountedByItsFault) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  ingest.take(InputKind::kPose, std::vector<std::uint8_t>{1, 2, 3}, kNow);
  EXPECT_FALSE(takenInput());
  std::uint64_t faults = 0;
  for (const std::uint64_t count : ingest.counters().decode_faults[static_cast<std::size_t>(InputKind::kPose)]) {
    faults += count;
  }
  EXPECT_EQ(faults, 1U);
}

TEST_F(IngestTest, FrameThatNobodyTookIsReplacedByTheNext) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  const CameraModel camera(test::smallCamera());
  for (const Duration age : {60ms, 30ms}) {
    const DepthImage image = test::flatImage(camera, 3000, kNow - age);
    ingest.take(InputKind::kDepth, bytesOf(toMessage(image, "front", DepthCompression::kRaw)), kNow - age);
  }
  std::optional<Time> stamp;
  while (hand_overs_.frames.take([&](const ArrivedFrame& frame) { stamp = frame.depth.image.stamp; })) {
  }
  EXPECT_EQ(stamp, kNow - 30ms);
  EXPECT_EQ(hand_overs_.frames.replaced(), 1U);
}

TEST_F(IngestTest, LossIsCountedByStream) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  const auto loss = [&](InputKind kind) { return ingest.counters().loss[static_cast<std::size_t>(kind)]; };
  BodyPose pose;
  for (const std::uint64_t sequence : {4U, 5U, 8U}) {
    pose.sequence = sequence;
    pose.stamp = kNow + std::chrono::milliseconds(sequence);
    ingest.take(InputKind::kPose, bytesOf(toMessage(pose, std::nullopt)), pose.stamp);
  }
  DepthImage image = test::flatImage(CameraModel(test::smallCamera()), 3000, kNow);
  for (const std::uint64_t sequence : {0U, 7U}) {
    image.sequence = sequence;
    image.stamp = kNow + std::chrono::milliseconds(sequence);
    ingest.take(InputKind::kDepth, bytesOf(toMessage(image, "front", DepthCompression::kRaw)), image.stamp);
  }
  Correction correction;
  for (const std::uint64_t sequence : {1U, 3U}) {
    correction.sequence = sequence;
    correction.poses = {{kNow + std::chrono::milliseconds(sequence), {}}};
    ingest.take(InputKind::kCorrection, bytesOf(toMessage(correction, kNow)), kNow);
  }
  EXPECT_EQ(loss(InputKind::kPose).missing, 2U);
  EXPECT_EQ(loss(InputKind::kDepth).missing, 6U);
  EXPECT_EQ(loss(InputKind::kCorrection).missing, 1U);
  EXPECT_EQ(loss(InputKind::kGoal).missing, 0U);
}

TEST_F(IngestTest, LossOfMessagesWithoutANumberIsSuspectedByTheirStamps) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  BodyPose pose;
  for (int i = 0; i < 50; ++i) {
    if (i == 40 || i == 41) continue;
    pose.stamp = kNow + i * 10ms;
    ingest.take(InputKind::kPose, bytesOf(toPoseMessage(pose, BodyConvention::kFlu)), pose.stamp);
  }
  const StreamLoss& loss = ingest.counters().loss[static_cast<std::size_t>(InputKind::kPose)];
  EXPECT_EQ(loss.missing, 0U);
  EXPECT_EQ(loss.suspected, 2U);
}

TEST_F(IngestTest, StepOfTheTimeOfDayIsCountedAndDoesNotAge) {
  Ingest ingest = ingestOf(ClockDomain::kRealtime, 1000s);
  ingest.noteRealtime(1000s, kNow);
  ingest.take(InputKind::kPose, poseAt(kNow + 1000s - 5ms), kNow);
  ingest.noteRealtime(400s, kNow + 10ms);
  ingest.take(InputKind::kPose, poseAt(kNow + 10ms + 400s - 5ms), kNow + 10ms);
  ASSERT_TRUE(takenInput());
  const auto input = takenInput();
  ASSERT_TRUE(input);
  EXPECT_EQ(std::get<PoseInput>(input->input).pose.stamp, kNow + 5ms);
  EXPECT_EQ(ingest.counters().clock_steps, 1U);
  EXPECT_EQ(ingest.counters().last_clock_step, -600s);
}

TEST_F(IngestTest, FullQueueDropsAndCounts) {
  Ingest ingest = ingestOf(ClockDomain::kMonotonic);
  const std::size_t capacity = hand_overs_.inputs.capacity();
  for (std::size_t i = 0; i < capacity + 3; ++i) ingest.take(InputKind::kPose, poseAt(kNow), kNow);
  EXPECT_EQ(hand_overs_.inputs.dropped(), 3U);
}

}  // namespace
}  // namespace nanomap
