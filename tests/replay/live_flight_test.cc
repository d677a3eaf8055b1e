#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/recording/log_source.h"
#include "firmware_app/flight/flight_process.h"
#include "firmware_app/flight/recording.h"
#include "firmware_app/realtime/realtime_facts.h"
#include "tests/replay/replaying.h"
#include "tests/unit/firmware_app/flight/shadowing_autopilot.h"
#include "tools/replay/decision_log.h"
#include "tools/replay/log_files.h"
#include "tools/replay/recorded_configuration.h"

namespace nanomap::test {
namespace {

using ::testing::IsEmpty;

/// The encoded decisions of a log.
std::vector<std::vector<std::uint8_t>> decisionBytes(const std::vector<std::filesystem::path>& files) {
  LogReader log(files);
  std::vector<std::vector<std::uint8_t>> decisions;
  std::vector<std::uint8_t> bytes;
  for (const LogEvent& event : log.events()) {
    log.read(event, bytes);
    if (messageHash(bytes) == decision_t::getHash()) decisions.push_back(bytes);
  }
  return decisions;
}

/// Flies a log in real time, as nanomap-flight does, and records the flight. The vehicle is handed over once it is
/// ready.
void flyAndRecord(const std::filesystem::path& log, const Configuration& configuration,
                  const std::filesystem::path& folder) {
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < kInputKindCount; ++i) {
    channels.push_back(channelOf(configuration.lcm, static_cast<InputKind>(i)));
  }
  LogSource source(LogReader(log), channels, 1.0, monotonicLogClock());
  ShadowingAutopilot autopilot;
  Stages stages(configuration, Duration::zero(), autopilot);
  Recording recording(folder.string(), configuration, stages.hand_overs);
  FlightOptions options;
  options.layout = defaultLayout(gatherRealtimeFacts(1).cores);
  options.demand_realtime = false;
  options.on_message = [&](const ReceivedMessage& message, Time arrival) {
    recording.recorder().onMessage(message.channel, arrival, message.bytes);
    if (message.channel == configuration.lcm.pose_channel) autopilot.move(message.bytes, arrival);
  };
  const FlightProcess process(options, source, stages);
  for (bool ordered = false; !process.sourceEnded(); sleepUntil(processNow() + std::chrono::milliseconds(20))) {
    State state = State::kWaiting;
    stages.hand_overs.sink_report.take([&](const SinkReport& report) { state = report.verdict.state; });
    if (!ordered && state == State::kReady) autopilot.order();
    ordered = ordered || state == State::kReady;
  }
}

TEST(LiveFlight, IsReplayedToTheSameDecisionsByteForByte) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.goal(0);
  log.fly(0, 6000);
  Configuration configuration;
  configuration.lcm.clock = ClockDomain::kLog;
  configuration.planner.objective.min_altitude_W_m = -10.0;
  const auto recordings = testFile("recordings");
  std::filesystem::remove_all(recordings);
  flyAndRecord(log.close(), configuration, recordings);

  const auto files = logFiles({recordings.string()});
  LogReader recording(files);
  const auto out = testFile("decisions");
  LogWriter decisions(out);
  const ReplayReport report =
      replay(recording, chooseConfiguration(recording, {}, {}).configuration, {}, {.decisions = &decisions});
  decisions.close();
  ASSERT_TRUE(report.steps);
  EXPECT_THAT(report.steps->losses, IsEmpty());
  const auto flown = decisionBytes(files);
  EXPECT_GT(flown.size(), 20U);
  EXPECT_EQ(decisionBytes({out}), flown);
  const auto made = readDecisions(files);
  EXPECT_TRUE(std::any_of(made.begin(), made.end(), [](const decision_t& decision) { return decision.flown != 0; }));
}

}  // namespace
}  // namespace nanomap::test
