#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "firmware_app/recorder/recorder.h"
#include "firmware_app/stages/stages.h"
#include "tests/replay/flown_recording.h"
#include "tests/replay/replaying.h"
#include "tools/replay/log_files.h"
#include "tools/replay/recorded_configuration.h"

namespace nanomap::test {
namespace {

using std::chrono::milliseconds;
using ::testing::IsEmpty;

/// An autopilot that is not there.
class NoAutopilot final : public AutopilotLink {
 public:
  void keepAlive(SystemStatus) override {}
  SendResult send(const LocalNedTarget&) override { return SendResult::kNoAutopilot; }
  SendResult send(const ObstacleDistances&) override { return SendResult::kNoAutopilot; }
  SendResult send(const OdometryMessage&) override { return SendResult::kNoAutopilot; }
  SendResult sendText(Severity, std::string_view) override { return SendResult::kNoAutopilot; }
  AutopilotState autopilot() const override { return {}; }
  std::optional<AutopilotPose> takePose() override { return std::nullopt; }
};

/// The stages of the flight process and its recorder, each of which runs or does not, as a draw decides.
std::filesystem::path recordStages(unsigned seed) {
  const FlownRecording flown = flownRecording(FlightMessages::kPlain, seed);
  Configuration configuration = flown.configuration;
  configuration.lcm.clock = ClockDomain::kRealtime;
  configuration.recorder = {.segment_mb = 1, .total_mb = 100, .buffer_mb = 10};
  const auto folder = testFile("recordings");
  std::filesystem::remove_all(folder);
  NoAutopilot autopilot;
  Stages stages(configuration, -flown.start.time_since_epoch(), autopilot);  // messages count from 0
  Recorder recorder(folder, configuration,
                    {stages.hand_overs.steps, stages.hand_overs.decisions, stages.hand_overs.setpoints}, flown.start);

  std::vector<RecordedEvent> messages = flown.events;
  std::erase_if(messages, [&](const RecordedEvent& event) { return !stages.ingest.kindOf(event.channel); });
  std::sort(messages.begin(), messages.end(),
            [](const RecordedEvent& a, const RecordedEvent& b) { return a.log_stamp < b.log_stamp; });
  std::mt19937 random(seed);
  const auto runs = [&random](double chance) { return std::bernoulli_distribution(chance)(random); };
  Time now = flown.start;
  for (auto message = messages.begin(); message != messages.end(); now += milliseconds(1)) {
    for (; message != messages.end() && message->log_stamp <= now; ++message) {
      const Time arrival = stages.ingest.arrivalAt(now);
      recorder.onMessage(message->channel, arrival, message->message);
      stages.ingest.take(*stages.ingest.kindOf(message->channel), message->message, arrival);
    }
    if (runs(0.03)) stages.capture(Duration::zero());
    if (runs(0.05)) stages.index.run();
    if (runs(0.3)) stages.chain.run(now);
    if (runs(0.03)) (void)stages.plan.run(now);
    if (runs(0.05)) stages.sink.run(now);
    stages.hand_overs.flown = now - flown.start > milliseconds(500) && now - flown.start < milliseconds(1500);
    if (runs(0.02)) recorder.run(now);
  }
  recorder.close(now);
  return folder;
}

/// Stamps and bytes.
std::vector<std::pair<Time, std::vector<std::uint8_t>>> messagesOn(const std::vector<std::filesystem::path>& files,
                                                                   const std::string& channel) {
  LogReader log(files);
  std::vector<std::pair<Time, std::vector<std::uint8_t>>> messages;
  for (const LogEvent& event : log.events()) {
    if (log.channelOf(event) != channel) continue;
    log.read(event, messages.emplace_back(event.log_stamp, std::vector<std::uint8_t>()).second);
  }
  return messages;
}

TEST(RecordedStages, AreReplayedToTheSameDecisionsByteForByte) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto files = logFiles({recordStages(seed).string()});
    LogReader log(files);
    const Configuration configuration = chooseConfiguration(log, {}, {}).configuration;
    const auto out = testFile("decisions");
    LogWriter decisions(out);
    const ReplayReport report = replay(log, configuration, {}, {.decisions = &decisions});
    decisions.close();
    ASSERT_TRUE(report.steps);
    EXPECT_THAT(report.steps->losses, IsEmpty());
    EXPECT_GT(countOf(report.steps->not_taken, InputKind::kDepth), 0U) << "some were overtaken";
    const auto recorded = messagesOn(files, configuration.lcm.decisions_channel);
    EXPECT_GT(recorded.size(), 15U);
    EXPECT_EQ(messagesOn({out}, configuration.lcm.decisions_channel), recorded);
    EXPECT_GT(report.plans.because(Reason::kFlying), 5U);
  }
}

}  // namespace
}  // namespace nanomap::test
