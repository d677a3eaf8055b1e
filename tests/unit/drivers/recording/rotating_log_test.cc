#include "drivers/recording/rotating_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "drivers/recording/log_reader.h"
#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr RotationLimits kLimits = {.segment_bytes = 1000, .total_bytes = 10'000};
constexpr std::size_t kMessageBytes = 100;

Time at(std::int64_t ms) { return Time(milliseconds(ms)); }

/// A message that tells its number.
std::vector<std::uint8_t> message(int number) {
  std::vector<std::uint8_t> bytes(kMessageBytes);
  bytes[0] = static_cast<std::uint8_t>(number >> 8);
  bytes[1] = static_cast<std::uint8_t>(number & 0xFF);
  return bytes;
}

struct ReadEvent {
  std::string channel;
  Time stamp{};
  int number = 0;
};

std::vector<ReadEvent> eventsOf(const std::filesystem::path& path) {
  LogReader log(path);
  std::vector<ReadEvent> events;
  std::vector<std::uint8_t> bytes;
  for (const LogEvent& event : log.events()) {
    log.read(event, bytes);
    events.push_back({log.channelOf(event), event.log_stamp, bytes.at(0) << 8 | bytes.at(1)});
  }
  return events;
}

/// Numbers of the events on a channel, over all recordings of the folder in their order.
std::vector<int> numbersIn(const std::filesystem::path& folder, const std::string& channel = "POSE") {
  std::vector<int> numbers;
  for (const LogSegment& segment : listSegments(folder)) {
    for (const ReadEvent& event : eventsOf(segment.path)) {
      if (event.channel == channel) numbers.push_back(event.number);
    }
  }
  return numbers;
}

std::vector<int> numbers(int first, int end) {
  std::vector<int> all;
  for (int i = first; i < end; ++i) all.push_back(i);
  return all;
}

class RotatingLogTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(RotatingLogTest, EventsAreAllThereOverSegmentsOfBoundedSize) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(log.write("POSE", at(i), message(i)));
  log.close();
  EXPECT_EQ(numbersIn(folder_.path()), numbers(0, 50));
  const auto segments = listSegments(folder_.path());
  EXPECT_EQ(segments.size(), 8U) << "seven events fit into each";
  for (const LogSegment& segment : segments) {
    EXPECT_LE(std::filesystem::file_size(segment.path), kLimits.segment_bytes);
    EXPECT_THAT(LogReader(segment.path).damage(), IsEmpty());
  }
  EXPECT_EQ(log.counters().events_written, 50U);
  EXPECT_EQ(log.counters().events_lost, 0U);
  EXPECT_EQ(log.counters().segments_begun, 8U);
  EXPECT_THAT(log.fault(), IsEmpty());
}

TEST_F(RotatingLogTest, SegmentMayBeFullToItsLastByte) {
  RotatingLog log(folder_.path(), {.segment_bytes = 4 * (28 + 4 + kMessageBytes), .total_bytes = 10'000}, at(0));
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(log.write("POSE", at(i), message(i)));
  log.close();
  EXPECT_EQ(listSegments(folder_.path()).size(), 2U);
}

TEST_F(RotatingLogTest, WhatHoldsStandsAtTheHeadOfEachSegmentAsItIsBegun) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  EXPECT_TRUE(log.write("CAMERA", at(0), message(1), Retention::kHolds));
  EXPECT_TRUE(log.write("GOAL", at(0), message(2), Retention::kHolds));
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(log.write("POSE", at(i), message(i)));
  EXPECT_TRUE(log.write("GOAL", at(10), message(3), Retention::kHolds));
  for (int i = 10; i < 20; ++i) EXPECT_TRUE(log.write("POSE", at(i), message(i)));
  log.close();
  EXPECT_EQ(numbersIn(folder_.path()), numbers(0, 20));
  const auto segments = listSegments(folder_.path());
  ASSERT_GE(segments.size(), 4U);
  const int goals[] = {2, 2, 3, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto events = eventsOf(segments[i].path);
    ASSERT_GE(events.size(), 3U);
    EXPECT_EQ(events[0].channel, "CAMERA");
    EXPECT_EQ(events[0].number, 1);
    EXPECT_EQ(events[1].channel, "GOAL");
    EXPECT_EQ(events[1].number, goals[i]);
    EXPECT_EQ(events[0].stamp, events[2].stamp) << "not of long ago: a player would wait for it";
    EXPECT_EQ(events[1].stamp, events[2].stamp);
  }
}

TEST_F(RotatingLogTest, EventThatBeginsASegmentReplacesWhatHeldOnItsChannel) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  for (int i = 0; i < 14; ++i) EXPECT_TRUE(log.write("GOAL", at(i), message(i), Retention::kHolds));
  log.close();
  EXPECT_EQ(numbersIn(folder_.path(), "GOAL"), numbers(0, 14));
}

TEST_F(RotatingLogTest, OldestAreDeletedAndOtherFilesLeft) {
  folder_.write("notes.txt", std::string(5000, 'x'));
  folder_.write(fileName({.flight = 1, .part = 1}), std::string(900, 'x'));
  folder_.write(fileName({.flight = 2, .part = 1}), std::string(900, 'x'));
  RotatingLog log(folder_.path(), kLimits, at(0));
  EXPECT_EQ(log.flight(), 3U);
  int i = 0;
  for (; i < 60; ++i) EXPECT_TRUE(log.write("POSE", at(i), message(i)));
  EXPECT_EQ(listSegments(folder_.path()).front().name.flight, 2U) << "the ninth segment needs the place of one";
  for (; i < 500; ++i) {
    EXPECT_TRUE(log.write("POSE", at(i), message(i)));
    std::uint64_t total_bytes = 0;
    for (const LogSegment& segment : listSegments(folder_.path())) {
      total_bytes += std::filesystem::file_size(segment.path);
    }
    ASSERT_LE(total_bytes, kLimits.total_bytes);
  }
  log.close();
  const auto kept = numbersIn(folder_.path());
  EXPECT_EQ(kept, numbers(kept.front(), 500));
  EXPECT_GE(kept.size(), 60U);
  EXPECT_EQ(log.counters().segments_deleted + listSegments(folder_.path()).size(), 2 + log.counters().segments_begun);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "notes.txt"));
}

TEST_F(RotatingLogTest, FlightsAreNumberedOn) {
  for (const std::uint32_t flight : {1U, 2U, 3U}) {
    RotatingLog log(folder_.path() / "recordings" / "made", kLimits, at(0));
    EXPECT_EQ(log.flight(), flight);
  }
}

TEST_F(RotatingLogTest, WithoutEventsNothingIsWritten) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  log.keepUp(at(1000));
  log.close();
  log.close();
  EXPECT_EQ(std::filesystem::file_size(log.path()), 0U);
  EXPECT_FALSE(log.write("POSE", at(1), message(1)));
  EXPECT_EQ(log.counters().events_lost, 1U);
  log.keepUp(at(2000));
  EXPECT_FALSE(log.write("POSE", at(1), message(1))) << "closed for good";
}

TEST_F(RotatingLogTest, EventThatNoSegmentCanHoldIsLostAlone) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  EXPECT_TRUE(log.write("CAMERA", at(0), message(0), Retention::kHolds));
  EXPECT_TRUE(log.write("POSE", at(1), message(1)));
  const std::vector<std::uint8_t> too_large(kLimits.segment_bytes - 28 - 4 - (28 + 6 + kMessageBytes) + 1);
  EXPECT_FALSE(log.write("POSE", at(2), too_large));
  EXPECT_TRUE(log.write("POSE", at(2), Bytes(too_large).first(too_large.size() - 1)));
  EXPECT_FALSE(log.write("bell\a", at(2), message(2)));
  EXPECT_FALSE(log.write("", at(2), message(2)));
  EXPECT_TRUE(log.write("POSE", at(3), message(3)));
  log.close();
  EXPECT_EQ(numbersIn(folder_.path()), (std::vector<int>{1, 0, 3}));
  EXPECT_EQ(log.counters().events_lost, 3U);
  EXPECT_THAT(log.fault(), IsEmpty()) << "the disk is well";
}

TEST_F(RotatingLogTest, StartIsRefusedWhereNothingCanBeWritten) {
  const auto file = folder_.write("file", "x");
  EXPECT_THAT([&] { RotatingLog(file, kLimits, at(0)); },
              ThrowsMessage<LogError>(AllOf(HasSubstr(file.string()), HasSubstr("check that"))));
  for (const RotationLimits limits : {RotationLimits{0, 0}, {1000, 1999}}) {
    EXPECT_THROW(RotatingLog(folder_.path(), limits, at(0)), std::invalid_argument);
  }
}

/// While it lives, files of this process cannot grow beyond a size, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t file_bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{file_bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST_F(RotatingLogTest, FullDiskIsCountedAndRecordingGoesOnWhenThereIsRoom) {
  RotatingLog log(folder_.path(), kLimits, at(0));
  EXPECT_TRUE(log.write("CAMERA", at(0), message(0), Retention::kHolds));
  EXPECT_TRUE(log.write("POSE", at(0), message(0)));
  log.keepUp(at(500));
  {
    const FullDisk full(100);
    EXPECT_TRUE(log.write("POSE", at(501), message(1))) << "buffered";
    log.keepUp(at(1000));
    EXPECT_THAT(log.fault(), HasSubstr("is the disk full?"));
    EXPECT_EQ(log.counters().events_lost, 1U);
    EXPECT_FALSE(log.write("POSE", at(1001), message(2)));
    for (int ms = 1500; ms < 10'000; ms += 500) {
      log.keepUp(at(ms));
      for (int i = 0; i < 4; ++i) (void)log.write("POSE", at(ms + i), message(3));
      EXPECT_THAT(log.fault(), Not(IsEmpty())) << ms;
    }
  }
  log.keepUp(at(10'000));
  EXPECT_TRUE(log.write("POSE", at(10'001), message(5)));
  log.keepUp(at(10'500));
  EXPECT_THAT(log.fault(), IsEmpty());
  log.close();
  EXPECT_EQ(numbersIn(folder_.path()).back(), 5);
  EXPECT_EQ(numbersIn(folder_.path(), "CAMERA").back(), 0) << "it still holds";
  EXPECT_EQ(log.counters().events_written, 2U + 4U + 1U) << "four were still buffered when the room came";
  EXPECT_EQ(log.counters().events_written + log.counters().events_lost, 2U + 2U + 4U * 17U + 1U);
  EXPECT_EQ(listSegments(folder_.path()).size(), 2U) << "vain attempts leave nothing behind";
}

TEST_F(RotatingLogTest, DeletedFolderIsNoticedAndMadeAgain) {
  RotatingLog log(folder_.path() / "gone", kLimits, at(0));
  EXPECT_TRUE(log.write("POSE", at(0), message(0)));
  std::filesystem::remove_all(folder_.path() / "gone");
  log.keepUp(at(500));
  EXPECT_THAT(log.fault(), HasSubstr("deleted"));
  EXPECT_EQ(log.counters().events_lost, 1U);
  log.keepUp(at(1000));
  EXPECT_TRUE(log.write("POSE", at(1001), message(1)));
  log.keepUp(at(1500));
  EXPECT_THAT(log.fault(), IsEmpty());
  EXPECT_THAT(numbersIn(folder_.path() / "gone"), ElementsAre(1));
}

TEST_F(RotatingLogTest, TimeThatGoesBackwardsDoesNotFlush) {
  RotatingLog log(folder_.path(), kLimits, at(1000));
  EXPECT_TRUE(log.write("POSE", at(0), message(0)));
  log.keepUp(at(0));
  EXPECT_EQ(log.counters().events_written, 0U);
  log.keepUp(at(1500));
  EXPECT_EQ(log.counters().events_written, 1U);
}

/// Writes an event each millisecond of a clock of its own for `duration_ms`, says so through the pipe and waits for its
/// end.
[[noreturn]] void recordUntilKilled(const std::filesystem::path& folder, int duration_ms, int pipe) {
  RotatingLog log(folder, {.segment_bytes = 100'000, .total_bytes = 10'000'000}, at(0));
  for (int ms = 0; ms < duration_ms; ++ms) {
    (void)log.write("POSE", at(ms), message(ms));
    log.keepUp(at(ms));
  }
  (void)!::write(pipe, "x", 1);
  for (;;) pause();
}

TEST_F(RotatingLogTest, KilledProcessLosesAtMostTheLastSecondAndLeavesReadableLogs) {
  constexpr int kDuration_ms = 4321;
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) recordUntilKilled(folder_.path(), kDuration_ms, pipe_ends[1]);
  char said = 0;
  EXPECT_EQ(::read(pipe_ends[0], &said, 1), 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(pipe_ends[0]);
  close(pipe_ends[1]);

  const auto kept = numbersIn(folder_.path());
  EXPECT_EQ(kept, numbers(0, static_cast<int>(kept.size()))) << "without a gap";
  EXPECT_GE(kept.size(), static_cast<std::size_t>(kDuration_ms - 1000));
  const auto segments = listSegments(folder_.path());
  EXPECT_GT(segments.size(), 1U);
  for (const LogSegment& segment : segments) {
    const LogReader log(segment.path);
    EXPECT_TRUE(std::all_of(log.damage().begin(), log.damage().end(),
                            [](const LogDamage& damage) { return damage.cause == LogDamage::Cause::kCutOff; }));
  }
}

}  // namespace
}  // namespace nanomap
