#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/tools/doctor/vehicle.h"

namespace nanomap::doctor {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

HeardStream& streamOf(Facts& facts, InputKind kind) { return facts.heard->streams[static_cast<std::size_t>(kind)]; }

void shiftStamps(Facts& facts, InputKind kind, Duration shift) {
  for (Sighting& sighting : streamOf(facts, kind).sightings) sighting.stamp += shift;
}

TEST(ChannelsCheck, HealthyVehicleIsFoundOnItsChannels) {
  EXPECT_EQ(verdictOf(checkChannels(healthyFacts())), Verdict::kOk);
}

TEST(ChannelsCheck, NothingAtAllIsOneFailure) {
  Facts facts;
  facts.heard.emplace();
  const Findings findings = checkChannels(facts);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].verdict, Verdict::kFailure);
}

TEST(ChannelsCheck, MissingStreamIsSoughtByItsType) {
  Facts facts = healthyFacts();
  facts.configuration.lcm.depth_channel = "CAM";
  streamOf(facts, InputKind::kDepth) = {};
  EXPECT_EQ(verdictOf(checkChannels(facts)), Verdict::kFailure);
  EXPECT_THAT(fixesOf(checkChannels(facts)), HasSubstr("lcm.depth_channel = \"DEPTH\""));
}

TEST(ChannelsCheck, ChannelThatIsConfiguredOtherwiseIsNotProposed) {
  Facts facts = healthyFacts();
  facts.configuration.lcm.depth_channel = "CAM";
  facts.configuration.lcm.goal_channel = "DEPTH";
  streamOf(facts, InputKind::kDepth) = {};
  EXPECT_THAT(fixesOf(checkChannels(facts)), Not(HasSubstr("\"DEPTH\"")));
}

TEST(ChannelsCheck, CameraIsNeededUnlessConfigured) {
  Facts facts = healthyFacts();
  std::erase_if(facts.heard->channels, [](const HeardChannel& channel) { return channel.name == "CAMERA"; });
  EXPECT_EQ(verdictOf(checkChannels(facts)), Verdict::kFailure);
  facts.configuration.camera = test::smallCamera();
  EXPECT_EQ(verdictOf(checkChannels(facts)), Verdict::kOk);
}

TEST(ChannelsCheck, WrongTypeIsToldFromAnOccasionalFault) {
  Facts facts = healthyFacts();
  HeardStream& depth = streamOf(facts, InputKind::kDepth);
  depth.unreadable = 1;
  depth.fault = "truncated";
  EXPECT_EQ(verdictOf(checkChannels(facts)), Verdict::kWarning);
  depth.messages = 0;
  EXPECT_EQ(verdictOf(checkChannels(facts)), Verdict::kFailure);
}

TEST(ClockCheck, HealthyStampsAreOfTheConfiguredClock) {
  Facts facts = healthyFacts();
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kOk);
  for (const InputKind kind : {InputKind::kPose, InputKind::kDepth}) {
    shiftStamps(facts, kind, facts.heard->realtime_ahead);
  }
  facts.configuration.lcm.clock = ClockDomain::kRealtime;
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kOk);
}

TEST(ClockCheck, OtherClockOfThisMachineIsNamed) {
  Facts facts = healthyFacts();
  shiftStamps(facts, InputKind::kPose, facts.heard->realtime_ahead);
  const Findings findings = checkClock(facts);
  EXPECT_EQ(verdictOf(findings), Verdict::kFailure);
  EXPECT_THAT(fixesOf(findings), HasSubstr("lcm.clock = \"realtime\""));
}

TEST(ClockCheck, ClockOfNobodyIsSaidToBeThat) {
  Facts facts = healthyFacts();
  shiftStamps(facts, InputKind::kDepth, -20h);
  const Findings findings = checkClock(facts);
  EXPECT_EQ(verdictOf(findings), Verdict::kFailure);
  EXPECT_THAT(findings[1].seen, HasSubstr("no other clock"));
}

TEST(ClockCheck, AgeAndLeadAreLimitedAsInFlight) {
  for (const Duration shift : std::initializer_list<Duration>{-300ms, 100ms}) {
    Facts facts = healthyFacts();
    shiftStamps(facts, InputKind::kDepth, shift);
    EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kFailure) << toSeconds(shift);
  }
}

TEST(ClockCheck, LogTellsItsDomainByTheSizeOfStamps) {
  Facts facts = healthyFacts();
  facts.heard->from_log = true;
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kOk);
  facts.configuration.lcm.clock = ClockDomain::kRealtime;
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kWarning);
  facts.configuration.lcm.clock = ClockDomain::kLog;
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kOk);
}

TEST(ClockCheck, NothingHeardIsNotLookedAt) {
  Facts facts;
  facts.heard.emplace();
  EXPECT_EQ(verdictOf(checkClock(facts)), Verdict::kNotLookedAt);
}

TEST(RatesCheck, GapsAndBackwardStampsAreWarnedOf) {
  Facts facts = healthyFacts();
  EXPECT_EQ(verdictOf(checkRates(facts)), Verdict::kOk);
  auto& poses = streamOf(facts, InputKind::kPose).sightings;
  std::swap(poses[10].stamp, poses[11].stamp);
  EXPECT_EQ(verdictOf(checkRates(facts)), Verdict::kWarning);
  std::swap(poses[10].stamp, poses[11].stamp);
  poses.erase(poses.begin() + 20, poses.begin() + 40);
  EXPECT_EQ(verdictOf(checkRates(facts)), Verdict::kWarning);
}

TEST(RatesCheck, PosesTooFarApartFail) {
  Facts facts = healthyFacts();
  streamOf(facts, InputKind::kPose) = {};
  hear(*facts.heard, InputKind::kPose, "POSE_BODY", "nanomap.body_pose_t", 5, 200, 5);
  EXPECT_EQ(verdictOf(checkRates(facts)), Verdict::kFailure);
}

TEST(RatesCheck, StampsThatStandStillFail) {
  Facts facts = healthyFacts();
  for (Sighting& sighting : streamOf(facts, InputKind::kDepth).sightings) sighting.stamp = atMs(7);
  EXPECT_EQ(verdictOf(checkRates(facts)), Verdict::kFailure);
}

TEST(RatesCheck, PosesHaveToSpanTheHistory) {
  Facts facts = healthyFacts();
  facts.configuration.chain.pose_capacity = 400;
  EXPECT_THAT(fixesOf(checkRates(facts)), HasSubstr("history.pose_capacity = "));
}

TEST(PosesAtFramesCheck, FramesInAGapOfThePosesAreCounted) {
  Facts facts = healthyFacts();
  EXPECT_EQ(verdictOf(checkPosesAtFrames(facts)), Verdict::kOk);
  auto& poses = facts.heard->poses;
  poses.erase(poses.begin() + 30, poses.begin() + 70);
  const Findings findings = checkPosesAtFrames(facts);
  EXPECT_EQ(verdictOf(findings), Verdict::kFailure);
  EXPECT_THAT(findings[0].seen, HasSubstr("13 in a gap"));
}

TEST(PosesAtFramesCheck, PosesThatAreNoneFail) {
  Facts facts = healthyFacts();
  for (BodyPose& pose : facts.heard->poses) pose.T_W_B.rotation.w() = 3.0;
  EXPECT_EQ(verdictOf(checkPosesAtFrames(facts)), Verdict::kFailure);
}

TEST(BodyCheck, UpsideDownAndOnItsSideAreTold) {
  const auto turned = [](double angle_rad) {
    Facts facts = healthyFacts();
    for (BodyPose& pose : facts.heard->poses) {
      pose.T_W_B.rotation = Quat(Eigen::AngleAxisd(angle_rad, Vec3::UnitX()));
    }
    return facts;
  };
  EXPECT_EQ(verdictOf(checkBody(turned(0.5))), Verdict::kOk);
  EXPECT_EQ(verdictOf(checkBody(turned(std::numbers::pi))), Verdict::kFailure);
  EXPECT_THAT(fixesOf(checkBody(turned(std::numbers::pi))), HasSubstr("nanomap.body_pose_t"));
  EXPECT_THAT(fixesOf(checkBody(turned(std::numbers::pi / 2.0))), HasSubstr("those of the camera"));
}

}  // namespace
}  // namespace nanomap::doctor
