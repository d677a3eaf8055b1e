#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "firmware_app/configuration/document.h"
#include "tests/replay/flown_recording.h"
#include "tests/replay/replaying.h"

namespace nanomap::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct Ended {
  int exit_code = 0;
  std::string out;
  std::string err;
};

/// nanomap-replay as a person starts it.
Ended runReplay(const std::string& arguments) {
  const auto out = testFile("stdout");
  const auto err = testFile("stderr");
  const std::string command =
      std::string(NANOMAP_REPLAY) + " " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytesOf(out), bytesOf(err)};
}

std::string flight() {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, 500);
  return "'" + log.close().string() + "' ";
}

TEST(ReplayProgram, WholeFlightEndsWithASummary) {
  const Ended run = runReplay(flight());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("depth frames: 6 in, 6 inserted"), HasSubstr("answered by the newest view"),
                             HasSubstr("p99"), HasSubstr("free")));
  EXPECT_EQ(run.err, "");
}

TEST(ReplayProgram, WritesItsAnswers) {
  const auto out = testFile("answers");
  const Ended run = runReplay(flight() + "--set lcm.answers_channel=A --set query.k=3 --from 0.1 --to 0.3 --out '" +
                              out.string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto answers = readAnswers(out);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].answers.answers[0].num_neighbours, 3);
  const LogReader log(out);
  EXPECT_EQ(log.channelOf(log.events().front()), "A");
}

TEST(ReplayProgram, DecidesComparesAndExplains) {
  const std::string log = flight() + "--goal 5,0,0 --set objective.min_altitude_W_m=-10 ";
  const std::string verified = "'" + testFile("verified").string() + "' ";
  const std::string paper = "'" + testFile("paper").string() + "' ";
  const Ended run = runReplay(log + "--decisions " + verified);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("decisions: 6;"), HasSubstr("a plan ")));
  EXPECT_EQ(runReplay(log + "--set planner.stop_check=paper --decisions " + paper).exit_code, 0);

  EXPECT_EQ(runReplay("--diff " + verified + verified).exit_code, 0);
  const Ended diff = runReplay("--diff " + verified + paper);
  EXPECT_EQ(diff.exit_code, 1);
  EXPECT_THAT(diff.out, AllOf(HasSubstr("they part 0.100 s"), HasSubstr("has_brake")));
  EXPECT_EQ(runReplay("--diff " + verified + flight()).exit_code, 2);

  EXPECT_THAT(runReplay(log + "--why 0.3").out, HasSubstr("plan made 0.300 s into the log"));
  EXPECT_THAT(runReplay(log + "--why 0.3 --candidate 62").out, HasSubstr("motion of candidate 62"));
  EXPECT_EQ(runReplay(log + "--why 9").exit_code, 1);
}

TEST(ReplayProgram, RecordedFlightIsReplayedToItsOwnDecisions) {
  const auto folder = testFile("recordings");
  std::filesystem::remove_all(folder);
  const RotationLimits limits{.segment_bytes = 200'000, .total_bytes = 10'000'000};
  writeSegments(flownRecording(FlightMessages::kPlain, 7).events, folder, limits);
  writeSegments(flownRecording(FlightMessages::kPlain).events, folder, limits);
  const std::string recordings = "'" + folder.string() + "' ";
  const std::string out = "'" + testFile("decisions").string() + "' ";
  const Ended run = runReplay(recordings + "--decisions " + out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("configuration: as recorded in the log\n"), HasSubstr("nothing is missing")));
  const Ended diff = runReplay("--diff " + recordings + out);
  EXPECT_EQ(diff.exit_code, 0) << diff.out << diff.err;
  EXPECT_THAT(diff.out, HasSubstr("all are the same"));

  const Ended other = runReplay(recordings + "--set planner.stop_check=paper --decisions " + out);
  EXPECT_THAT(other.out, HasSubstr("configuration: as recorded in the log, with 1 set otherwise\n"));
  EXPECT_EQ(runReplay("--diff " + recordings + out).exit_code, 1);
}

TEST(ReplayProgram, TwoOutputsNeedTwoFiles) {
  const std::string out = "'" + testFile("out").string() + "' ";
  const Ended run = runReplay(flight() + "--out " + out + "--decisions " + out);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("name two files"));
}

TEST(ReplayProgram, OverrideBeforeTheLogDoesNotSwallowIt) {
  EXPECT_EQ(runReplay("--set query.k=3 " + flight()).exit_code, 0);
}

TEST(ReplayProgram, MissingLogIsNamed) {
  const Ended run = runReplay("/nonexistent.lcmlog");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("/nonexistent.lcmlog"));
  EXPECT_EQ(runReplay("").exit_code, 1);
}

TEST(ReplayProgram, FileThatIsNoLogIsRefused) {
  const auto path = testFile("text");
  std::ofstream(path) << std::string(1000, 'x');
  const Ended run = runReplay("'" + path.string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("not an LCM log"));
}

TEST(ReplayProgram, EmptyLogIsRefused) {
  const auto path = testFile("empty");
  std::ofstream{path};
  const Ended run = runReplay("'" + path.string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("holds no event"));
}

TEST(ReplayProgram, LogWithoutACameraFails) {
  FlightLog log(testFile("blind"));
  log.fly(0, 100);
  const Ended run = runReplay("'" + log.close().string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.out, HasSubstr("no camera model yet"));
  EXPECT_THAT(run.err, HasSubstr("[camera]"));
}

TEST(ReplayProgram, NeverOverwritesItsOwnLog) {
  const std::string log = flight();
  const Ended run = runReplay(log + "--out " + log);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("is the log itself"));
  EXPECT_EQ(runReplay(log).exit_code, 0);
}

TEST(ReplayProgram, ToBeforeFromIsRefused) {
  const Ended run = runReplay(flight() + "--from 0.4 --to 0.2");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("--from"));
}

TEST(ReplayProgram, OptionsOutOfRangeAreRefused) {
  EXPECT_NE(runReplay(flight() + "--rate 0").exit_code, 0);
  EXPECT_NE(runReplay(flight() + "--from nan").exit_code, 0);
  EXPECT_NE(runReplay(flight() + "--from -1").exit_code, 0);
  EXPECT_NE(runReplay(flight() + "--goal 1,2").exit_code, 0);
  EXPECT_NE(runReplay(flight() + "--goal 1,2,nan").exit_code, 0);
  EXPECT_NE(runReplay(flight() + "--goal-speed 0").exit_code, 0);
}

TEST(ReplayProgram, CheckConfigPrintsWhatHoldsWithoutALog) {
  const Ended run = runReplay("--check-config --set history.views=42");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("views = 42  # default 150"));
}

TEST(ReplayProgram, CheckConfigRefusesAMisspeltKey) {
  const auto path = testFile("config");
  std::ofstream(path) << "[history]\nveiws = 3\n";
  const Ended run = runReplay("--check-config --config '" + path.string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr(path.string() + ":2: unknown key 'history.veiws': did you mean 'history.views'?"));
}

TEST(ReplayProgram, HelpConfigIsTheDefaultFile) { EXPECT_EQ(runReplay("--help-config").out, annotatedToml({})); }

}  // namespace
}  // namespace nanomap::test
