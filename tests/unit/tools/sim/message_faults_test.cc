#include "tools/sim/message_faults.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/lcm/encode.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::ThrowsMessage;

constexpr Time kDeparture = Time(100s);

class MessageFaultsTest : public testing::Test {
 protected:
  using Sent = std::vector<std::pair<std::string, std::vector<std::uint8_t>>>;

  /// What becomes of a message, 1 s after the departure and later.
  Sent pass(MessageFaults& faults, const std::string& channel, Duration since_departure,
            const std::vector<std::uint8_t>& message) {
    Sent sent;
    faults.pass(channel, kDeparture + since_departure, message, since_departure,
                [&](const std::string& on, Bytes bytes) {
                  sent.emplace_back(on, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
                });
    return sent;
  }

  MessageFaults faultsOf(MessageFault fault) const { return {lcm_, {{fault, {1s, 2s}}}}; }

  template <class Message>
  static std::vector<std::uint8_t> bytesOf(const Message& message) {
    std::vector<std::uint8_t> bytes;
    EXPECT_TRUE(encodeInto(message, bytes));
    return bytes;
  }
  static std::vector<std::uint8_t> depthOf(std::uint16_t raw, Time stamp) {
    return bytesOf(
        toMessage(test::flatImage(CameraModel(test::smallCamera()), raw, stamp), "depth", DepthCompression::kRaw));
  }
  static DepthImage imageOf(const std::vector<std::uint8_t>& bytes) {
    return std::get<DepthImage>(toDepthImage(std::get<depth_image_t>(decode<depth_image_t>(bytes))));
  }

  LcmParameters lcm_;
  std::vector<std::uint8_t> any_{1, 2, 3, 4};
};

TEST_F(MessageFaultsTest, NothingHappensBeforeOrAfter) {
  for (std::size_t i = 0; i < kMessageFaultCount; ++i) {
    MessageFaults faults = faultsOf(static_cast<MessageFault>(i));
    for (const std::string& channel : {lcm_.depth_channel, lcm_.pose_channel, lcm_.goal_channel}) {
      EXPECT_EQ(pass(faults, channel, 999ms, any_), (Sent{{channel, any_}}));
      EXPECT_EQ(pass(faults, channel, 3s, any_), (Sent{{channel, any_}}));
    }
  }
}

TEST_F(MessageFaultsTest, FrozenPictureKeepsItsStampsFresh) {
  MessageFaults faults = faultsOf(MessageFault::kCameraFrozen);
  EXPECT_EQ(imageOf(pass(faults, lcm_.depth_channel, 1s, depthOf(3000, Time(1s)))[0].second).pixels[0], 3000);
  const DepthImage later = imageOf(pass(faults, lcm_.depth_channel, 2s, depthOf(4000, Time(2s)))[0].second);
  EXPECT_EQ(later.pixels[0], 3000);
  EXPECT_EQ(later.stamp, Time(2s));
}

TEST_F(MessageFaultsTest, LateMessagesComeAllTheSame) {
  MessageFaults faults = faultsOf(MessageFault::kPosesLate);
  EXPECT_THAT(pass(faults, lcm_.pose_channel, 1s, any_), IsEmpty());
  EXPECT_THAT(pass(faults, lcm_.depth_channel, 1s + MessageFaults::kLateness - 1ms, any_), SizeIs(1));
  EXPECT_THAT(pass(faults, lcm_.depth_channel, 1s + MessageFaults::kLateness, any_), SizeIs(2));
}

TEST_F(MessageFaultsTest, FlickeringCameraComesAndGoes) {
  MessageFaults faults = faultsOf(MessageFault::kCameraFlickers);
  std::size_t came = 0;
  for (Duration at = 1s; at < 3s; at += 10ms) came += pass(faults, lcm_.depth_channel, at, any_).size();
  EXPECT_GT(came, 50U);
  EXPECT_LT(came, 150U);
}

TEST_F(MessageFaultsTest, GarbageIsAsLongAndAnother) {
  MessageFaults faults = faultsOf(MessageFault::kCameraGarbage);
  const Sent sent = pass(faults, lcm_.depth_channel, 1s, depthOf(3000, Time(1s)));
  EXPECT_THAT(sent[0].second, SizeIs(depthOf(3000, Time(1s)).size()));
  EXPECT_NE(sent[0].second, depthOf(3000, Time(1s)));
}

TEST_F(MessageFaultsTest, PlacesAndGoalsBecomeNonsense) {
  MessageFaults poses = faultsOf(MessageFault::kPosesNotANumber);
  const auto pose = pass(poses, lcm_.pose_channel, 1s, bytesOf(toMessage(BodyPose{}, std::nullopt)))[0].second;
  EXPECT_TRUE(std::isnan(std::get<body_pose_t>(decode<body_pose_t>(pose)).world_from_body.translation[0]));
  MessageFaults goals = faultsOf(MessageFault::kGoalNonsense);
  const auto goal = pass(goals, lcm_.goal_channel, 1s, bytesOf(goal_t{}))[0].second;
  EXPECT_FALSE(std::isfinite(std::get<goal_t>(decode<goal_t>(goal)).position[0]));
}

TEST_F(MessageFaultsTest, CorrectionsJumpByTurns) {
  MessageFaults faults = faultsOf(MessageFault::kCorrectionsJump);
  Correction correction;
  correction.poses.resize(2);
  std::set<double> places;
  for (int i = 0; i < 2; ++i) {
    const auto sent = pass(faults, lcm_.correction_channel, 1s, bytesOf(toMessage(correction, Time(1s))));
    places.insert(
        std::get<pose_correction_t>(decode<pose_correction_t>(sent[0].second)).poses[1].transform.translation[1]);
  }
  EXPECT_THAT(places, SizeIs(2));
}

TEST_F(MessageFaultsTest, FloodComesWithEveryPoseAndHoldsNothingBack) {
  MessageFaults faults = faultsOf(MessageFault::kFlood);
  EXPECT_THAT(pass(faults, lcm_.depth_channel, 1s, any_), SizeIs(1));
  const Sent sent = pass(faults, lcm_.pose_channel, 1s, any_);
  EXPECT_GT(sent.size(), 10U);
  EXPECT_EQ(sent.back(), (Sent::value_type{lcm_.pose_channel, any_}));
}

TEST(MessageFaultText, IsReadAndRefusedByName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kMessageFaultCount; ++i) {
    const auto fault = static_cast<MessageFault>(i);
    names.insert(toString(fault));
    EXPECT_EQ(parseMessageFault("--fault", std::string(toString(fault)) + ":5:1.5").fault, fault);
  }
  EXPECT_EQ(names.size(), kMessageFaultCount);
  EXPECT_EQ(parseMessageFault("--fault", "flood:5:1.5").when.lasts, 1500ms);
  for (const char* text : {"", "flood", "flood:", "flood:1", "fire:1:1"}) {
    EXPECT_THAT([&] { (void)parseMessageFault("--fault", text); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("--fault")))
        << text;
  }
}

}  // namespace
}  // namespace nanomap::sim
