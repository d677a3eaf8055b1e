#include "firmware_app/recorder/recorder.h"

#include <gmock/gmock.h>

#include <map>
#include <variant>

#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/document.h"
#include "firmware_app/configuration/load.h"
#include "nanomap/decision_t.hpp"
#include "nanomap/lost_t.hpp"
#include "nanomap/setpoint_t.hpp"
#include "nanomap/step_t.hpp"
#include "nanomap/text_t.hpp"
#include "tests/support/allocations.h"
#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Time at(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

const std::vector<std::uint8_t> kBytes = {1, 2, 3};

Configuration smallRecorder() {
  Configuration configuration;
  configuration.recorder = {.segment_mb = 1, .total_mb = 10, .buffer_mb = 1};
  configuration.planner.risk.max_risk = 0.002;
  return configuration;
}

class RecorderTest : public ::testing::Test {
 protected:
  RecorderPorts ports() { return {steps_, decisions_, setpoints_}; }

  void step(std::uint64_t number) {
    steps_.push([&](Step& slot) { slot = {at(10), number, InputKind::kPose, at(9), Duration(7)}; });
  }

  void setpoint(std::int64_t ms, State state, bool sent) {
    setpoints_.push([&](SentSetpoint& slot) {
      slot = {};
      slot.stamp = at(ms);
      slot.verdict.state = state;
      if (sent) slot.motion.emplace();
    });
  }

  /// The messages of a type on a channel of the recording.
  template <class Message>
  std::vector<Message> recorded(const Recorder& recorder, const std::string& channel) {
    LogReader log(recorder.path());
    std::vector<Message> messages;
    std::vector<std::uint8_t> bytes;
    for (const LogEvent& event : log.events()) {
      if (log.channelOf(event) != channel) continue;
      log.read(event, bytes);
      messages.push_back(std::get<Message>(decode<Message>(bytes)));
    }
    return messages;
  }

  TemporaryFolder folder_;
  Configuration configuration_ = smallRecorder();
  SlotQueue<Step> steps_{4};
  SlotQueue<MadeDecision> decisions_{4};
  SlotQueue<SentSetpoint> setpoints_{4};
};

TEST_F(RecorderTest, ConfigurationIsRecordedFirst) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  recorder.close(at(1));
  const auto texts = recorded<text_t>(recorder, std::string(kConfigurationChannel));
  ASSERT_THAT(texts, SizeIs(1));
  EXPECT_EQ(annotatedToml(parseConfiguration(texts[0].text, "recorded")), annotatedToml(configuration_));
}

TEST_F(RecorderTest, MessagesAreRecordedVerbatimAtTheirArrival) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  recorder.onMessage("POSE_BODY", at(5), kBytes);
  recorder.onMessage("DEPTH", at(6), {});
  recorder.close(at(10));
  LogReader log(recorder.path());
  ASSERT_THAT(log.events(), SizeIs(3));
  EXPECT_EQ(log.channelOf(log.events()[1]), "POSE_BODY");
  EXPECT_EQ(log.events()[1].log_stamp, at(5));
  std::vector<std::uint8_t> bytes;
  log.read(log.events()[1], bytes);
  EXPECT_EQ(bytes, kBytes);
  EXPECT_EQ(log.events()[2].data_bytes, 0U);
}

TEST_F(RecorderTest, StepsAndDecisionsKeepTheirPlace) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  step(1);
  step(2);
  decisions_.push([](MadeDecision& slot) {
    slot.decision.stamp = at(12);
    slot.sequence = 3;
    slot.step = 2;
    slot.flown = true;
  });
  recorder.close(at(20));
  const auto steps = recorded<step_t>(recorder, configuration_.lcm.steps_channel);
  ASSERT_THAT(steps, SizeIs(2));
  EXPECT_EQ(steps[1].number, 2);
  EXPECT_EQ(steps[1].arrival_utime, 9000);
  EXPECT_EQ(steps[1].stamp_shift, 7);
  const auto decisions = recorded<decision_t>(recorder, configuration_.lcm.decisions_channel);
  ASSERT_THAT(decisions, SizeIs(1));
  EXPECT_EQ(decisions[0].utime, 12'000);
  EXPECT_EQ(decisions[0].sequence, 3);
  EXPECT_EQ(decisions[0].step, 2);
  EXPECT_TRUE(decisions[0].flown);
}

TEST_F(RecorderTest, SetpointsAreRecordedAndChangesOfTheStateOnce) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  setpoint(10, State::kWaiting, false);
  setpoint(20, State::kReady, true);
  setpoint(30, State::kReady, true);
  recorder.run(at(31));
  setpoint(40, State::kReady, true);
  recorder.close(at(50));
  EXPECT_THAT(recorded<setpoint_t>(recorder, configuration_.lcm.setpoints_channel), SizeIs(3));
  std::vector<std::string> states;
  for (const text_t& text : recorded<text_t>(recorder, configuration_.lcm.state_channel)) states.push_back(text.text);
  EXPECT_THAT(states, ElementsAre(toString(State::kWaiting), toString(State::kReady)));
}

TEST_F(RecorderTest, HealthIsRecorded) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  health_t health{};
  health.utime = 1000;
  health.state = "ready";
  recorder.onHealth(health);
  recorder.close(at(20));
  const auto reports = recorded<health_t>(recorder, configuration_.lcm.health_channel);
  ASSERT_THAT(reports, SizeIs(1));
  EXPECT_EQ(reports[0].state, "ready");
}

TEST_F(RecorderTest, WhatIsLostIsCountedAndToldByTapAtItsPlace) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  for (std::uint64_t number = 1; number <= 7; ++number) step(number);
  recorder.run(at(20));
  step(8);
  recorder.run(at(30));
  const std::vector<std::uint8_t> too_large(1'000'001);
  recorder.onMessage("DEPTH", at(35), too_large);
  step(9);
  recorder.close(at(40));
  const auto losses = recorded<lost_t>(recorder, configuration_.lcm.lost_channel);
  ASSERT_THAT(losses, SizeIs(2));
  EXPECT_EQ(losses[0].tap, "steps");
  EXPECT_EQ(losses[0].count, 3);
  EXPECT_EQ(losses[0].utime, 20'000);
  EXPECT_EQ(losses[1].tap, "messages");
  EXPECT_EQ(losses[1].count, 1);
  RecorderReport report;
  EXPECT_TRUE(recorder.report().take([&](const RecorderReport& newest) { report = newest; }));
  EXPECT_EQ(report.dropped[static_cast<std::size_t>(Tap::kSteps)], 3U);
  EXPECT_EQ(report.dropped[static_cast<std::size_t>(Tap::kMessages)], 1U);
  EXPECT_THAT(report.fault, IsEmpty());
}

TEST_F(RecorderTest, WhatTheLogLosesIsToldWhenItIsWellAgain) {
  const auto folder = folder_.path() / "gone";
  Recorder recorder(folder, configuration_, ports(), at(0));
  recorder.onMessage("POSE_BODY", at(5), kBytes);
  std::filesystem::remove_all(folder);
  recorder.run(at(600));
  RecorderReport report;
  recorder.report().take([&](const RecorderReport& newest) { report = newest; });
  EXPECT_FALSE(report.fault.empty());
  for (const std::int64_t ms : {1200, 1800, 2400}) {
    recorder.onMessage("POSE_BODY", at(ms), kBytes);
    recorder.run(at(ms));
  }
  recorder.close(at(3000));
  const auto losses = recorded<lost_t>(recorder, configuration_.lcm.lost_channel);
  ASSERT_THAT(losses, SizeIs(1));
  EXPECT_EQ(losses[0].tap, "events of the log");
  EXPECT_EQ(losses[0].count, 3) << "the configuration, the first message, and one while there was no folder";
}

TEST_F(RecorderTest, HandingOverAllocatesNothing) {
  Recorder recorder(folder_.path(), configuration_, ports(), at(0));
  const std::vector<std::uint8_t> large(500'000);
  const std::size_t before = test::allocationCount();
  recorder.onMessage("DEPTH", at(1), large);
  recorder.onMessage("POSE_BODY", at(2), kBytes);
  recorder.onMessage("DEPTH", at(3), large);
  recorder.onMessage("DEPTH", at(4), large);
  step(1);
  setpoint(5, State::kReady, true);
  EXPECT_EQ(test::allocationCount(), before);
}

}  // namespace
}  // namespace nanomap
