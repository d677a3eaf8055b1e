#include "tools/replay/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/replay/replaying.h"
#include "tools/replay/warnings.h"

namespace nanomap::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

std::filesystem::path smallFlight(std::int64_t to_ms = 1000) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, to_ms);
  return log.close();
}

TEST(Replay, EveryFrameOfAWholeFlightIsAnswered) {
  const ReplayReport report = replayed(smallFlight());
  EXPECT_EQ(report.chain.views_inserted, 11U);
  EXPECT_EQ(report.answered_frames, 11U);
  EXPECT_EQ(report.build_times.size(), 11U);
  EXPECT_EQ(report.query_times.size(), 11U);
  EXPECT_EQ(report.chain.posesAccepted(), 101U);
  EXPECT_EQ(report.fan.total(), 11U * 9U * 3U * 10U);
  EXPECT_TRUE(report.has_camera);
  EXPECT_TRUE(report.damage.empty());
  EXPECT_EQ(report.log_span, std::chrono::seconds(1));
  expectEveryFrameCounted(report);
}

TEST(Replay, AnswersAreThoseOfCore) {
  const Configuration configuration;
  const auto flight = smallFlight();
  const auto answers = readAnswers(answersOf(flight, "answers"));
  ASSERT_EQ(answers.size(), 11U);

  Chain chain(configuration.chain);
  const auto camera = model(smallCamera());
  for (std::int64_t ms = 0; ms <= 1000; ms += 10) {
    (void)chain.addPose(FlightLog::flightPose(ms));
    if (ms % 100 == 0) (void)chain.addView(viewOf(FlightLog::flightImage(ms), camera));
  }
  const ChainSnapshot snapshot = chain.snapshot();
  const answers_t& last = answers.back().answers;
  EXPECT_EQ(last.utime, 1'000'000);
  EXPECT_EQ(last.pose_sequence, 1000);
  EXPECT_EQ(last.num_views, 11);
  const auto fan = fanPoints(FanParameters{}, snapshot.T_W_B.rotation, 10.0);
  ASSERT_EQ(last.answers.size(), fan.size()) << "nothing of the flight lies ahead of its last frame";
  std::uint64_t free = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const QueryReply reply = query(snapshot, fan[i], configuration.planner.risk.query);
    EXPECT_EQ(last.answers[i].status, static_cast<std::int8_t>(reply.status));
    EXPECT_EQ(last.answers[i].distances.at(0), reply.neighbours[0].distance_m);
    EXPECT_EQ(static_cast<std::uint32_t>(last.answers[i].view_index), reply.view_index.value());
    if (reply.status == Status::kFree) ++free;
  }
  EXPECT_GT(free, 0U);
}

TEST(Replay, ThePathFlownNextLiesAheadOfTheBody) {
  const auto answers = readAnswers(answersOf(smallFlight(), "answers"));
  const answers_t& first = answers.front().answers;
  const auto flown_count = first.num_answers - first.num_fan;
  ASSERT_EQ(flown_count, 6) << "150 ms apart, up to the flight's end after 1 s";
  for (int i = 0; i < flown_count; ++i) {
    const answer_t& answer = first.answers[static_cast<std::size_t>(first.num_fan + i)];
    EXPECT_NEAR(answer.mean_body[0], 0.15 * (i + 1), 1e-9);
    EXPECT_NEAR(answer.mean_body[1], 0.0, 1e-9);
  }
}

TEST(Replay, TwoRunsWriteTheSameBytes) {
  const auto flight = smallFlight();
  const std::string first = bytesOf(answersOf(flight, "first"));
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, bytesOf(answersOf(flight, "second")));
}

TEST(Replay, RateChangesNoByte) {
  const auto flight = smallFlight(200);
  ReplayOptions paced;
  paced.rate = 1000.0;
  EXPECT_EQ(bytesOf(answersOf(flight, "unpaced")), bytesOf(answersOf(flight, "paced", {}, paced)));
}

TEST(Replay, AnswersAreStampedWithTheEventThatMadeThem) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.pose(0);
  log.depth(100);
  log.pose(90);
  log.pose(110);
  const auto answers = readAnswers(answersOf(log.close(), "answers"));
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].log_stamp, atMs(110));
  EXPECT_EQ(answers[0].answers.utime, 110'000);
}

TEST(Replay, MessagesAreMergedByLogTime) {
  FlightLog log(testFile("flight"));
  for (std::int64_t ms = 0; ms <= 300; ms += 100) log.depth(ms);
  for (std::int64_t ms = 0; ms <= 300; ms += 10) log.pose(ms);
  log.camera(0);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(report.chain.views_inserted, 3U);
  EXPECT_EQ(countOf(report.pipeline.camera_faults, CameraFault::kNoCamera), 1U) << "logged before the camera";
}

TEST(Replay, FromAndToCutTheLog) {
  ReplayOptions options;
  options.span.from = std::chrono::milliseconds(300);
  options.span.to = std::chrono::milliseconds(600);
  const auto flight = smallFlight();
  const auto answers = readAnswers(answersOf(flight, "answers", {}, options));
  ASSERT_EQ(answers.size(), 4U) << "the camera of before is known";
  EXPECT_EQ(answers.front().log_stamp, atMs(300));
  EXPECT_EQ(answers.front().answers.num_views, 1);
  EXPECT_EQ(answers.back().log_stamp, atMs(600));
  EXPECT_GT(answers.back().answers.num_answers, answers.back().answers.num_fan) << "the log goes on behind --to";
  EXPECT_EQ(countOf(replayed(flight, {}, options).pipeline.messages, InputKind::kPose), 31U);
}

TEST(Replay, CorrectionsReachTheChain) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, 500);
  Correction correction;
  correction.sequence = 1;
  for (std::int64_t ms = 0; ms <= 500; ms += 100) {
    Pose moved = FlightLog::flightPose(ms).T_W_B;
    moved.translation_m.x() *= 1.1;
    correction.poses.push_back({atMs(ms), moved});
  }
  log.correction(505, correction);
  log.correction(506, correction);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(countOf(report.chain.corrections, CorrectionVerdict::kAccepted), 1U);
  EXPECT_EQ(countOf(report.chain.corrections, CorrectionVerdict::kOutOfOrder), 1U);
  EXPECT_EQ(report.chain.edges_corrected, 5U);
}

TEST(Replay, JumpOfAStreamWithoutEpochsCutsTheHistory) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  for (std::int64_t ms = 0; ms <= 400; ms += 10) {
    log.plainPose(ms, ms > 200 ? 50.0 : 0.0);
    if (ms % 100 == 0) log.depth(ms);
  }
  const auto path = log.close();
  const auto answers = readAnswers(answersOf(path, "answers"));
  ASSERT_EQ(answers.size(), 5U);
  EXPECT_EQ(answers[2].answers.num_views, 3);
  EXPECT_EQ(answers[2].answers.num_answers, answers[2].answers.num_fan) << "its next seconds are in another world";
  EXPECT_EQ(answers[3].answers.epoch, 1);
  EXPECT_EQ(answers[3].answers.num_views, 1);

  Configuration trusting;
  trusting.lcm.max_body_speed_m_s = 0.0;
  EXPECT_EQ(readAnswers(answersOf(path, "trusting", trusting)).back().answers.num_views, 5);
}

TEST(Replay, ChangedCameraIsUsedAndReported) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, 100);
  CameraParameters moved = smallCamera();
  moved.T_B_C.translation_m.x() = 0.2;
  log.camera(150, moved);
  log.fly(160, 300);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(report.chain.views_inserted, 4U);
  ASSERT_EQ(report.camera_changes.size(), 1U);
  EXPECT_EQ(report.camera_changes[0], std::chrono::milliseconds(150));
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("camera model changed 1 times, first after 0.150 s")));
}

TEST(Replay, ConfiguredCameraReplacesTheLogs) {
  Configuration configuration;
  configuration.camera = smallCamera();
  FlightLog log(testFile("flight"));
  log.fly(0, 200);
  log.camera(300, smallCamera(32, 24));
  const ReplayReport report = replayed(log.close(), configuration);
  EXPECT_EQ(report.chain.views_inserted, 3U);
  EXPECT_EQ(countOf(report.pipeline.cameras, CameraVerdict::kOverridden), 1U);
  EXPECT_THAT(warningsOf(report, configuration), Contains(HasSubstr("the configuration has [camera]")));
}

TEST(Replay, MissingChannelIsNamedWithThoseThatAreThere) {
  Configuration configuration;
  configuration.lcm.pose_channel = "VIO";
  const ReplayReport report = replayed(smallFlight(), configuration);
  EXPECT_EQ(report.answered_frames, 0U);
  EXPECT_THAT(warningsOf(report, configuration),
              Contains(HasSubstr("no poses found on channel VIO; channels in this log: CAMERA, DEPTH, POSE_BODY")));
}

TEST(Replay, WholeFlightHasNoWarningUnlessPosesAreTakenForPerfect) {
  const ReplayReport report = replayed(smallFlight());
  EXPECT_THAT(warningsOf(report, {}), ::testing::IsEmpty());
  Configuration perfect;
  perfect.chain.drift.horizontal_std_m = 0.0;
  perfect.chain.drift.vertical_std_m = 0.0;
  EXPECT_THAT(warningsOf(report, perfect), ::testing::ElementsAre(HasSubstr("taken for perfect")));
}

}  // namespace
}  // namespace nanomap::test
