#include "firmware_app/supervision/watchdog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr Duration kPeriod = 10ms;
constexpr Duration kLongestPause = 20ms;

/// Two threads and who watches them; `planner` may work for 100 ms and wait for ever, `sink` may work for 30 ms and
/// wait for 40 ms.
class WatchdogTest : public ::testing::Test {
 protected:
  /// Names of the stalled, in order.
  std::vector<std::string> judge() {
    std::vector<std::string> names;
    for (const Stall& stall : watchdog_.judge(now_)) names.push_back(stall.thread->name);
    return names;
  }

  /// Judges at every period from now on for `duration`. @return the stalled at its end
  std::vector<std::string> pass(Duration duration) {
    std::vector<std::string> stalled;
    for (const Time end = now_ + duration; now_ < end;) {
      now_ += kPeriod;
      stalled = judge();
    }
    return stalled;
  }

  void sinkAlive() { sink_.ended(); }

  Progress planner_;
  Progress sink_;
  Watchdog watchdog_{{{.name = "planner", .progress = &planner_, .longest_work = 100ms, .longest_wait = std::nullopt},
                      {.name = "sink", .progress = &sink_, .longest_work = 30ms, .longest_wait = 40ms}},
                     kLongestPause};
  Time now_{1000s};
};

TEST_F(WatchdogTest, NobodyIsStalledAtFirst) { EXPECT_THAT(judge(), IsEmpty()); }

TEST_F(WatchdogTest, WorkIsAStallWhenItTakesLongerThanItMay) {
  sinkAlive();
  planner_.working();
  judge();
  EXPECT_THAT(pass(100ms), IsEmpty());
  EXPECT_THAT(pass(10ms), ElementsAre("planner"));
  planner_.working();
  EXPECT_THAT(judge(), IsEmpty()) << "the next piece of work";
  EXPECT_THAT(pass(110ms), ElementsAre("planner"));
  planner_.waiting();
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(WatchdogTest, WaitingForWorkIsNoStall) {
  sinkAlive();
  planner_.waiting();
  EXPECT_THAT(pass(1h), IsEmpty());
}

TEST_F(WatchdogTest, WaitThatHasALimitIsAStallBeyondIt) {
  planner_.ended();
  sink_.waiting();
  judge();
  EXPECT_THAT(pass(40ms), IsEmpty());
  EXPECT_THAT(pass(10ms), ElementsAre("sink"));
}

TEST_F(WatchdogTest, ThreadThatNeverStartsIsStalled) {
  judge();
  EXPECT_THAT(pass(30ms), IsEmpty());
  EXPECT_THAT(pass(10ms), ElementsAre("sink"));
  EXPECT_THAT(pass(70ms), ElementsAre("planner", "sink"));
}

TEST_F(WatchdogTest, ThreadThatHasEndedIsNotStalled) {
  planner_.ended();
  sink_.ended();
  EXPECT_THAT(pass(1h), IsEmpty());
}

TEST_F(WatchdogTest, ProgressBetweenTwoJudgementsIsSeen) {
  sinkAlive();
  for (int i = 0; i < 100; ++i) {
    planner_.working();
    EXPECT_THAT(pass(90ms), IsEmpty());
    planner_.waiting();
    planner_.working();
  }
}

TEST_F(WatchdogTest, StoppedProcessIsNobodysStall) {
  planner_.working();
  sink_.waiting();
  judge();
  now_ += 1h;
  EXPECT_THAT(judge(), IsEmpty());
  EXPECT_THAT(pass(20ms), IsEmpty());
  EXPECT_THAT(pass(10ms), ElementsAre("sink")) << "it has not gone on with the process";
}

TEST_F(WatchdogTest, WatchdogThatIsAlwaysLateFindsAStallAllTheSame) {
  sinkAlive();
  planner_.working();
  judge();
  int judgements = 0;
  do {
    now_ += 10s;
    ++judgements;
    ASSERT_LT(judgements, 10);
  } while (judge().empty());
  EXPECT_EQ(judgements, 100ms / kLongestPause + 1);
}

TEST_F(WatchdogTest, TimeThatGoesBackwardsDoesNotCount) {
  sinkAlive();
  planner_.working();
  pass(60ms);
  now_ -= 1h;
  EXPECT_THAT(judge(), IsEmpty());
  EXPECT_THAT(pass(40ms), IsEmpty());
  EXPECT_THAT(pass(20ms), ElementsAre("planner"));
}

TEST_F(WatchdogTest, StallSaysWhoAndForHowLong) {
  sinkAlive();
  planner_.working();
  judge();
  pass(120ms);
  const auto stalls = watchdog_.judge(now_);
  ASSERT_EQ(stalls.size(), 1U);
  EXPECT_EQ(stalls[0].activity, Activity::kWorking);
  EXPECT_EQ(stalls[0].lasting, 120ms);
  EXPECT_EQ(toText(stalls[0]), "planner has been working for 120 ms, 100 ms at most are allowed");
}

TEST(Watchdog, WithoutThreadsNobodyIsStalled) {
  Watchdog watchdog({}, kLongestPause);
  EXPECT_THAT(watchdog.judge(Time(0s)), IsEmpty());
}

TEST(Watchdog, LimitsThatCannotBeAreNamed) {
  const Progress progress;
  const auto make = [](const WatchedThread& thread, Duration pause) { return [=] { Watchdog({thread}, pause); }; };
  EXPECT_THAT(
      make({.name = "a", .progress = &progress, .longest_work = 1s, .longest_wait = std::nullopt}, 1s),
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("longest work of thread a"), HasSubstr("above 1000 ms"))));
  EXPECT_THAT(make({.name = "b", .progress = &progress, .longest_work = 2s, .longest_wait = 1s}, 1s),
              ThrowsMessage<std::invalid_argument>(HasSubstr("longest wait of thread b")));
  EXPECT_THAT(make({.name = "c", .progress = nullptr, .longest_work = 1s, .longest_wait = std::nullopt}, 1s),
              ThrowsMessage<std::invalid_argument>(HasSubstr("thread c")));
  EXPECT_THAT(make({.name = "d", .progress = &progress, .longest_work = 1s, .longest_wait = std::nullopt}, 0s),
              ThrowsMessage<std::invalid_argument>(HasSubstr("longest pause")));
}

}  // namespace
}  // namespace nanomap
