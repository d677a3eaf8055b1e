#include "drivers/recording/log_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/drivers/recording/log_bytes.h"
#include "tests/unit/drivers/temporary_file.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Wait = MessageSource::Wait;

/// A log on channels A and B, and the clock that plays it; waiting takes no time.
class LogSourceTest : public ::testing::Test {
 protected:
  LogSource play(const std::string& log, double rate = 1.0) {
    file_.write(log);
    return {LogReader(file_.path()), {"A", "B"}, rate, {[this] { return now_; }, [this](Time time) { now_ = time; }}};
  }

  Wait wait(LogSource& source, Duration timeout) {
    return source.wait(timeout, [this](const ReceivedMessage& message) {
      heard_.emplace_back(message.bytes.begin(), message.bytes.end());
      channels_.emplace_back(message.channel);
      stamps_.push_back(message.log_stamp.value());
      heard_at_.push_back(now_ - kStart);
    });
  }

  static constexpr Time kStart = Time(1000s);
  TemporaryFile file_;
  Time now_ = kStart;
  std::vector<std::string> heard_;
  std::vector<std::string> channels_;
  std::vector<Time> stamps_;
  std::vector<Duration> heard_at_;
};

TEST_F(LogSourceTest, EmptyLogHasEnded) {
  LogSource source = play("");
  EXPECT_EQ(wait(source, 1s), Wait::kEnded);
  EXPECT_EQ(now_, kStart) << "nothing to wait for";
}

TEST_F(LogSourceTest, MessagesComeAtTheirTimesFromTheFirstOn) {
  LogSource source = play(event(5'000'000, "A", "one") + event(5'999'999, "B", "two") + event(6'000'001, "A", "three"));
  while (wait(source, 1s) != Wait::kEnded) {
  }
  EXPECT_THAT(heard_, ElementsAre("one", "two", "three"));
  EXPECT_THAT(channels_, ElementsAre("A", "B", "A"));
  EXPECT_THAT(heard_at_, ElementsAre(0s, 999'999us, 1'000'001us));
  EXPECT_THAT(stamps_, ElementsAre(Time(5s), Time(5'999'999us), Time(6'000'001us)));
}

TEST_F(LogSourceTest, RateStretchesLogTime) {
  LogSource source = play(event(0, "A", "") + event(1'000'000, "A", "") + event(3'000'000, "A", ""), 4.0);
  while (wait(source, 1s) != Wait::kEnded) {
  }
  EXPECT_THAT(heard_at_, ElementsAre(0ms, 250ms, 750ms));
}

TEST_F(LogSourceTest, TimeoutEndsAWaitBeforeTheNextMessage) {
  LogSource source = play(event(0, "A", "") + event(100'000, "A", ""));
  EXPECT_EQ(wait(source, 0s), Wait::kHandled);
  EXPECT_EQ(wait(source, 60ms), Wait::kTimeout);
  EXPECT_EQ(now_ - kStart, 60ms);
  EXPECT_EQ(wait(source, 60ms), Wait::kHandled);
  EXPECT_EQ(now_ - kStart, 100ms);
  EXPECT_EQ(wait(source, 60ms), Wait::kEnded);
}

TEST_F(LogSourceTest, WaitThatASignalEndsIsATimeout) {
  file_.write(event(0, "A", "") + event(100'000, "A", ""));
  LogSource source(LogReader(file_.path()), {"A"}, 1.0, {[this] { return now_; }, [](Time) {}});
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  EXPECT_EQ(wait(source, 1s), Wait::kTimeout);
  EXPECT_EQ(heard_.size(), 1U);
}

TEST_F(LogSourceTest, WhatNobodyWaitedForComesAtOnceAndInOrder) {
  LogSource source =
      play(event(0, "A", "a") + event(10'000, "A", "b") + event(20'000, "A", "c") + event(90'000, "A", "d"));
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  now_ += 50ms;
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  EXPECT_THAT(heard_, ElementsAre("a", "b", "c"));
  EXPECT_EQ(now_ - kStart, 50ms);
}

TEST_F(LogSourceTest, OtherChannelsArePassedOver) {
  LogSource source = play(event(0, "C", "no") + event(1'000'000, "A", "yes") + event(2'000'000, "C", "no"));
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  EXPECT_THAT(heard_, ElementsAre("yes"));
  EXPECT_EQ(now_, kStart);
  EXPECT_EQ(wait(source, 1s), Wait::kEnded);
}

TEST_F(LogSourceTest, StampsThatGoBackwardsArePutInOrder) {
  LogSource source = play(event(20, "A", "late") + event(10, "B", "early") + event(20, "B", "same time"));
  while (wait(source, 1s) != Wait::kEnded) {
  }
  EXPECT_THAT(heard_, ElementsAre("early", "late", "same time"));
  EXPECT_THAT(heard_at_, ElementsAre(0us, 10us, 10us));
}

TEST_F(LogSourceTest, JumpOfTheRecordingClockIsNotSatThrough) {
  constexpr std::int64_t kFiftyYears_us = 50LL * 365 * 24 * 3600 * 1'000'000;
  LogSource source = play(event(0, "A", "") + event(kFiftyYears_us, "A", "") + event(kFiftyYears_us + 5, "A", ""), 2.0);
  while (wait(source, 60s) != Wait::kEnded) {
  }
  EXPECT_THAT(heard_at_, ElementsAre(0ns, kLongestLogPause / 2, kLongestLogPause / 2 + 2500ns));
}

TEST_F(LogSourceTest, DamageIsSkipped) {
  LogSource source = play(event(0, "A", "one") + "garbage" + event(1, "A", "two"));
  while (wait(source, 1s) != Wait::kEnded) {
  }
  EXPECT_THAT(heard_, ElementsAre("one", "two"));
  EXPECT_EQ(source.damage().size(), 1U);
}

TEST_F(LogSourceTest, MessageThatIsGoneIsCounted) {
  const std::string first = event(0, "A", "one");
  LogSource source = play(first + event(1, "A", "two"));
  std::filesystem::resize_file(file_.path(), first.size() + 30);
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  EXPECT_EQ(wait(source, 1s), Wait::kTimeout);
  EXPECT_EQ(wait(source, 1s), Wait::kEnded);
  EXPECT_THAT(heard_, ElementsAre("one"));
  EXPECT_EQ(source.unreadable(), 1U);
}

TEST_F(LogSourceTest, HandlerThatThrowsLosesOnlyItsOwnMessage) {
  LogSource source = play(event(0, "A", "one") + event(0, "A", "two"));
  EXPECT_THROW((void)source.wait(1s, [](const ReceivedMessage&) { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(wait(source, 1s), Wait::kHandled);
  EXPECT_THAT(heard_, ElementsAre("two"));
}

TEST_F(LogSourceTest, RateThatIsNotPositiveIsNamed) {
  for (const double rate : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([&] { play("", rate); }, ThrowsMessage<std::invalid_argument>(HasSubstr("must be positive"))) << rate;
  }
}

TEST(MonotonicLogClock, WaitsUntilTheTime) {
  const LogClock clock = monotonicLogClock();
  const Time end = clock.now() + 2ms;
  clock.wait_until(end);
  EXPECT_GE(clock.now(), end);
}

}  // namespace
}  // namespace nanomap
