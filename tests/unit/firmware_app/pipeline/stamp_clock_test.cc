#include "firmware_app/pipeline/stamp_clock.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Duration kMaxLead = 50ms;

Time at(Duration since_start) { return Time(1000s + since_start); }
Time stamped(Duration since_start) { return Time(since_start); }

TEST(StampClock, OwnClockNeedsNoShift) {
  StampClock clock(ClockDomain::kMonotonic, kMaxLead, 5s);
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(3s), at(0s)), Duration::zero());
}

TEST(StampClock, TimeOfDayIsShiftedByItsLead) {
  StampClock clock(ClockDomain::kRealtime, kMaxLead, 5s);
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(3s), at(0s)), -5s);
}

/// A stream of stamps of the time of day, whose messages arrive 5 ms after, on a host whose time of day is set.
class HostThatIsSet : public ::testing::TestWithParam<Duration> {
 protected:
  /// The age that a message of `kind` seems to have, which was stamped at `stamped` and arrives at `arrived`.
  Duration age(Time stamped, Time arrived) {
    clock_.noteRealtime(aheadAt(arrived), arrived);
    const Time stamp = stamped + aheadAt(stamped);
    return arrived - (stamp + *clock_.shift(InputKind::kDepth, stamp, arrived));
  }
  [[nodiscard]] Duration aheadAt(Time time) const { return time < kSet ? kAhead : kAhead + GetParam(); }

  static constexpr Duration kAhead = 1'000'000s;
  static constexpr Time kSet = Time(1010s);
  StampClock clock_{ClockDomain::kRealtime, kMaxLead, kAhead};
};

TEST_P(HostThatIsSet, KeepsAFreshStreamFresh) {
  for (Time now = at(0s); now < at(60s); now += 10ms) {
    const Duration measured = age(now - 5ms, now);
    EXPECT_LE(measured, 5ms + kMaxLead) << toSeconds(now - kSet);
    if (now < kSet || now > kSet + 100ms) {
      EXPECT_EQ(measured, 5ms) << toSeconds(now - kSet);
    }
  }
}

TEST_P(HostThatIsSet, KeepsAStaleStreamStale) {
  for (Time now = at(5s); now < at(60s); now += 10ms) (void)age(now - 5ms, now);
  for (Time now = at(60s); now < at(61s); now += 10ms) EXPECT_EQ(age(now - 3s, now), 3s);
  EXPECT_GE(age(kSet - 100ms, at(61s)), 10s) << "from before it was set";
}

TEST_P(HostThatIsSet, TellsByHowMuchAndOnce) {
  EXPECT_FALSE(clock_.noteRealtime(kAhead + 1ms, at(1s))) << "an error of measuring";
  EXPECT_EQ(clock_.noteRealtime(kAhead + GetParam(), at(2s)), GetParam());
  EXPECT_FALSE(clock_.noteRealtime(kAhead + GetParam(), at(3s)));
}

INSTANTIATE_TEST_SUITE_P(StampClock, HostThatIsSet, ::testing::Values(7ms, 300ms, 3600s, -7ms, -300ms, -3600s));

TEST(StampClock, StreamWhoseOwnClockStepsIsNotHelped) {
  StampClock clock(ClockDomain::kRealtime, kMaxLead, 5s);
  EXPECT_FALSE(clock.noteRealtime(5s, at(0s)));
  EXPECT_EQ(clock.shift(InputKind::kPose, Time(1005s - 10s), at(0s)), -5s) << "stale by 10 s, and stays so";
}

TEST(StampClock, StampThatFitsBothSidesOfAStepBackIsFromBeforeIfItWouldLeadByMoreThanItMay) {
  for (const Duration max_lead : {50ms, 500ms}) {
    StampClock clock(ClockDomain::kRealtime, max_lead, 0s);
    EXPECT_FALSE(clock.noteRealtime(0s, at(1s)));
    EXPECT_EQ(clock.noteRealtime(-300ms, at(2s)), -300ms);
    const Duration shift_if_before = 0s;
    const Duration shift_if_after = 300ms;
    EXPECT_EQ(clock.shift(InputKind::kPose, at(2s), at(2s)), max_lead < 300ms ? shift_if_before : shift_if_after);
  }
}

TEST(StampClock, TimeOfDayDoesNotMatterToOwnClock) {
  StampClock clock(ClockDomain::kMonotonic, kMaxLead, 5s);
  EXPECT_FALSE(clock.noteRealtime(5000s, at(1s)));
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(3s), at(1s)), Duration::zero());
}

TEST(StampClock, LogIsShiftedAsItsTimeliestPoseOfTheBeginning) {
  StampClock clock(ClockDomain::kLog, kMaxLead, 5s);
  EXPECT_FALSE(clock.shift(InputKind::kDepth, stamped(0s), at(0s)));
  EXPECT_FALSE(clock.shift(InputKind::kPose, stamped(0ms), at(70ms)));   // late
  EXPECT_FALSE(clock.shift(InputKind::kPose, stamped(10ms), at(71ms)));  // late
  EXPECT_FALSE(clock.shift(InputKind::kPose, stamped(300ms), at(301ms)));
  EXPECT_FALSE(clock.shift(InputKind::kDepth, stamped(300ms), at(350ms)));
  const auto shift = clock.shift(InputKind::kPose, stamped(600ms), at(620ms));
  ASSERT_TRUE(shift);
  EXPECT_LT(*shift, at(301ms) - stamped(300ms));
  EXPECT_GT(*shift, at(301ms) - stamped(300ms) - 20ms);
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(900ms), at(1s)), shift);
}

TEST(StampClock, GoalFromBeforeALogsClockHoldsFromItsArrival) {
  StampClock clock(ClockDomain::kLog, kMaxLead, 0s);
  EXPECT_EQ(clock.shift(InputKind::kGoal, stamped(1s), at(3s)), at(3s) - stamped(1s));
}

TEST(ShiftStamps, MovesEveryStampAndStaysWithinRange) {
  Correction correction;
  correction.poses = {{stamped(1s), {}}, {stamped(2s), {}}};
  Input input = correction;
  shiftStamps(input, 10s);
  EXPECT_EQ(std::get<Correction>(input).poses[0].stamp, stamped(11s));
  EXPECT_EQ(stampOf(input), stamped(12s));
  shiftStamps(input, -20s);
  EXPECT_EQ(stampOf(input), stamped(0s));
  input = CameraInput{};
  EXPECT_FALSE(stampOf(input));
}

}  // namespace
}  // namespace nanomap
