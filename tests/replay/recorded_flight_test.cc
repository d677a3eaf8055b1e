#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/lcm/encode.h"
#include "nanomap/decision_t.hpp"
#include "nanomap/lost_t.hpp"
#include "nanomap/step_t.hpp"
#include "tests/replay/flown_recording.h"
#include "tests/replay/replaying.h"
#include "tools/replay/decision_diff.h"
#include "tools/replay/decision_log.h"
#include "tools/replay/log_files.h"
#include "tools/replay/recorded_configuration.h"
#include "tools/replay/summary.h"
#include "tools/replay/warnings.h"
#include "tools/replay/why.h"

namespace nanomap::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// What a replay of these events writes.
struct Replayed {
  ReplayReport report;
  std::vector<RecordedEvent> decisions;

  [[nodiscard]] std::vector<std::string> losses() const {
    std::vector<std::string> words;
    for (const RecordingLoss& loss : report.steps->losses) words.push_back(loss.what);
    return words;
  }
};

std::vector<RecordedEvent> eventsOf(LogReader log) {
  std::vector<RecordedEvent> events;
  for (const LogEvent& event : log.events()) {
    log.read(event, events.emplace_back(RecordedEvent{log.channelOf(event), event.log_stamp, {}}).message);
  }
  return events;
}

Replayed replayedFiles(const std::vector<std::filesystem::path>& files, const Configuration& configuration,
                       const ReplayOptions& options = {}) {
  LogReader log(files);
  const auto out = testFile("decisions");
  LogWriter decisions(out);
  ReplayReport report = replay(log, configuration, options, {.decisions = &decisions});
  decisions.close();
  return {std::move(report), eventsOf(LogReader(out))};
}

Replayed replayedFlight(const FlownRecording& flown, const ReplayOptions& options = {}) {
  return replayedFiles({writeLog(flown.events, testFile("flight"))}, flown.configuration, options);
}

/// The same events, to the last byte and in the same order.
bool same(const std::vector<RecordedEvent>& a, const std::vector<RecordedEvent>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const RecordedEvent& x, const RecordedEvent& y) {
    return x.channel == y.channel && x.log_stamp == y.log_stamp && x.message == y.message;
  });
}

std::size_t countBecause(const std::vector<RecordedEvent>& decisions, const std::string& reason) {
  return static_cast<std::size_t>(std::count_if(decisions.begin(), decisions.end(), [&](const RecordedEvent& event) {
    return std::get<decision_t>(decode<decision_t>(event.message)).reason == reason;
  }));
}

/// The one event on a channel for which the message's field is `number`.
template <class Message>
std::vector<RecordedEvent>::iterator find(FlownRecording& flown, const std::string& channel,
                                          std::int64_t Message::*field, std::int64_t number) {
  return std::find_if(flown.events.begin(), flown.events.end(), [&](const RecordedEvent& event) {
    return event.channel == channel && std::get<Message>(decode<Message>(event.message)).*field == number;
  });
}

auto stepOf(FlownRecording& flown, std::int64_t number) {
  return find(flown, flown.configuration.lcm.steps_channel, &step_t::number, number);
}

auto decisionOf(FlownRecording& flown, std::int64_t sequence) {
  return find(flown, flown.configuration.lcm.decisions_channel, &decision_t::sequence, sequence);
}

std::vector<RecordedEvent> decisionsOf(const FlownRecording& flown) {
  return flown.on(flown.configuration.lcm.decisions_channel);
}

class RecordedFlight : public ::testing::TestWithParam<FlightMessages> {
 protected:
  FlownRecording flown_ = flownRecording(GetParam());
};

INSTANTIATE_TEST_SUITE_P(OfBothFamilies, RecordedFlight,
                         ::testing::Values(FlightMessages::kNumbered, FlightMessages::kPlain),
                         [](const auto& test) { return test.param == FlightMessages::kPlain ? "Plain" : "Numbered"; });

TEST_P(RecordedFlight, IsReplayedToTheSameDecisionsByteForByte) {
  ASSERT_GT(flown_.frames_dropped, 5U);
  ASSERT_GT(flown_.overtaken, 20U);
  ASSERT_GT(flown_.decisions, 30U);
  ASSERT_GT(countBecause(decisionsOf(flown_), "flying"), 10U);
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_TRUE(same(replayed.decisions, decisionsOf(flown_)));
  EXPECT_THAT(replayed.losses(), IsEmpty());
  EXPECT_EQ(replayed.report.steps->taken, flown_.on(flown_.configuration.lcm.steps_channel).size());
  EXPECT_EQ(countOf(replayed.report.steps->not_taken, InputKind::kDepth), flown_.frames_dropped);
  EXPECT_THAT(summaryOf(replayed.report, flown_.configuration),
              AllOf(HasSubstr("nothing is missing"), HasSubstr("depth frames arrived and were not taken in"),
                    Not(HasSubstr("decisions may not be those of the flight"))));
}

TEST_P(RecordedFlight, OfAnySeedIsReplayedToTheSameDecisions) {
  for (const unsigned seed : {2U, 3U, 4U}) {
    const FlownRecording flown = flownRecording(GetParam(), seed);
    EXPECT_FALSE(same(decisionsOf(flown), decisionsOf(flown_))) << "another flight";
    EXPECT_TRUE(same(replayedFlight(flown).decisions, decisionsOf(flown))) << seed;
  }
}

TEST_P(RecordedFlight, IsReplayedFromItsParts) {
  const auto folder = testFile("parts");
  std::filesystem::remove_all(folder);
  writeSegments(flown_.events, folder, {.segment_bytes = 100'000, .total_bytes = 10'000'000});
  const auto files = logFiles({folder.string()});
  ASSERT_GT(files.size(), 3U);
  const Replayed replayed = replayedFiles(files, flown_.configuration);
  EXPECT_TRUE(same(replayed.decisions, decisionsOf(flown_)));
  EXPECT_THAT(replayed.losses(), IsEmpty());
}

TEST_P(RecordedFlight, WithoutItsStepsIsReplayedByArrivalToOtherDecisions) {
  std::erase_if(flown_.events,
                [&](const RecordedEvent& event) { return event.channel == flown_.configuration.lcm.steps_channel; });
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_FALSE(replayed.report.steps);
  EXPECT_FALSE(same(replayed.decisions, decisionsOf(flown_)));
  EXPECT_GT(replayed.decisions.size(), flown_.decisions) << "every frame that arrived is planned for";
}

TEST_P(RecordedFlight, MissingStepIsSaidOnceAndTheReplayGoesOn) {
  const auto step = stepOf(flown_, 150);
  const Time at = step->log_stamp;
  flown_.events.erase(step);
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_THAT(replayed.losses(), ElementsAre("steps 150 are missing"));
  const Time said = replayed.report.steps->losses.front().at;
  EXPECT_GE(said, at);
  EXPECT_LE(said, at + std::chrono::milliseconds(20));
  EXPECT_EQ(replayed.decisions.size(), flown_.decisions);
  EXPECT_THAT(warningsOf(replayed.report, flown_.configuration),
              Contains(HasSubstr("decisions may not be those of the flight")));
}

TEST_P(RecordedFlight, MissingMessageIsNamedByItsStep) {
  const auto step = std::get<step_t>(decode<step_t>(stepOf(flown_, 150)->message));
  const auto& channel = channelOf(flown_.configuration.lcm, static_cast<InputKind>(step.kind));
  std::erase_if(flown_.events, [&](const RecordedEvent& event) {
    return event.channel == channel && utimeFromTime(event.log_stamp) == step.arrival_utime;
  });
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_THAT(replayed.losses(), ElementsAre(HasSubstr("the message that step 150 took in")));
  EXPECT_EQ(replayed.decisions.size(), flown_.decisions);
}

TEST_P(RecordedFlight, MissingDecisionIsNamedAndThoseBeforeAreTheSame) {
  flown_.events.erase(decisionOf(flown_, 20));
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_THAT(replayed.losses(), ElementsAre("decisions 20 are missing"));
  const auto made = decisionsOf(flown_);
  ASSERT_EQ(replayed.decisions.size(), made.size());
  EXPECT_TRUE(same({replayed.decisions.begin(), replayed.decisions.begin() + 20}, {made.begin(), made.begin() + 20}));
}

TEST_P(RecordedFlight, WhatTheRecorderSaysThatItLostIsSaid) {
  lost_t lost{};
  lost.tap = "raw messages";
  lost.count = lost.total = 12;
  RecordedEvent event{flown_.configuration.lcm.lost_channel, flown_.start + std::chrono::milliseconds(700), {}};
  ASSERT_TRUE(encodeInto(lost, event.message));
  flown_.events.insert(flown_.events.begin() + 100, event);
  const Replayed replayed = replayedFlight(flown_);
  EXPECT_THAT(replayed.losses(), ElementsAre("12 raw messages were not recorded"));
  EXPECT_THAT(summaryOf(replayed.report, flown_.configuration), HasSubstr("after 0.700 s: 12 raw messages"));
  EXPECT_TRUE(same(replayed.decisions, decisionsOf(flown_))) << "none that a step took in";
}

TEST_P(RecordedFlight, WithoutItsBeginningIsReplayedFromWhatHoldsOn) {
  const auto folder = testFile("parts");
  std::filesystem::remove_all(folder);
  writeSegments(flown_.events, folder, {.segment_bytes = 100'000, .total_bytes = 10'000'000});
  auto files = logFiles({folder.string()});
  files.erase(files.begin(), files.begin() + 2);
  const Replayed replayed = replayedFiles(files, flown_.configuration);
  EXPECT_THAT(replayed.losses(), Contains(HasSubstr("steps 1 .. ")));
  EXPECT_TRUE(replayed.report.has_camera);
  EXPECT_GT(replayed.decisions.size(), 10U);
  EXPECT_GT(countBecause(replayed.decisions, "flying"), 0U) << "camera and goal are those of the head";
}

TEST_P(RecordedFlight, CutOffRecordingIsReplayedUpToItsEnd) {
  flown_.events.resize(flown_.events.size() / 2);
  const Replayed replayed = replayedFlight(flown_);
  const auto made = decisionsOf(flown_);
  ASSERT_GT(made.size(), 10U);
  EXPECT_TRUE(same(replayed.decisions, made));
}

TEST_P(RecordedFlight, SpanLeavesStepsAndDecisionsOut) {
  ReplayOptions options;
  options.span.from = std::chrono::milliseconds(500);
  options.span.to = std::chrono::milliseconds(1000);
  const Replayed replayed = replayedFlight(flown_, options);
  ASSERT_FALSE(replayed.decisions.empty());
  EXPECT_GE(replayed.decisions.front().log_stamp, flown_.start + options.span.from);
  EXPECT_LE(std::get<decision_t>(decode<decision_t>(replayed.decisions.back().message)).utime,
            utimeFromTime(flown_.start + *options.span.to));
  EXPECT_TRUE(replayed.report.has_camera);
  EXPECT_GT(countBecause(replayed.decisions, "flying"), 0U);
}

TEST_P(RecordedFlight, ItsOwnConfigurationIsTakenUnlessAnotherIsGiven) {
  LogReader log(writeLog(flown_.events, testFile("flight")));
  const auto own = chooseConfiguration(log, {}, {});
  EXPECT_EQ(own.configuration.planner.objective.min_altitude_W_m, -10.0);
  EXPECT_EQ(own.origin, "as recorded in the log");
  const auto changed = chooseConfiguration(log, {}, {"history.views=7"});
  EXPECT_EQ(changed.configuration.planner.objective.min_altitude_W_m, -10.0);
  EXPECT_EQ(changed.configuration.chain.history_views, 7U);
  EXPECT_EQ(changed.origin, "as recorded in the log, with 1 set otherwise");
  std::ofstream(testFile("toml")) << "[history]\nviews = 8\n";
  const auto given = chooseConfiguration(log, testFile("toml"), {});
  EXPECT_EQ(given.configuration.planner.objective.min_altitude_W_m, Configuration{}.planner.objective.min_altitude_W_m);
  EXPECT_EQ(given.origin, testFile("toml").string());
}

TEST_P(RecordedFlight, WhyAsksThePlansThatWereMade) {
  LogReader log(writeLog(flown_.events, testFile("flight")));
  const Duration at = decisionsOf(flown_).at(25).log_stamp - flown_.start;
  const std::string text = why(log, flown_.configuration, {}, {.at = at});
  EXPECT_THAT(text, HasSubstr("plan made " + std::to_string(toSeconds(at)).substr(0, 4)));
}

TEST_P(RecordedFlight, StepsOfTwoFlightsAreRefused) {
  const auto first = writeLog(flown_.events, testFile("first"));
  const auto second = writeLog(flownRecording(GetParam(), 2).events, testFile("second"));
  EXPECT_THAT(
      [&] {
        (void)replayedFiles({first, second}, flown_.configuration);
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("two flights")));
}

TEST(LogFiles, FolderIsItsLatestFlight) {
  const auto folder = testFile("recordings");
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  EXPECT_THAT([&] { (void)logFiles({folder.string()}); }, ThrowsMessage<std::runtime_error>(HasSubstr("flight-")));
  for (const SegmentName name : {SegmentName{1, 1}, {2, 1}, {2, 2}}) std::ofstream(folder / fileName(name)) << "x";
  EXPECT_THAT(logFiles({folder.string(), "other.lcmlog"}),
              ElementsAre(folder / fileName({2, 1}), folder / fileName({2, 2}), "other.lcmlog"));
}

}  // namespace
}  // namespace nanomap::test
