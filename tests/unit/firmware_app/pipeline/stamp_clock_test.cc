#include "firmware_app/pipeline/stamp_clock.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

Time at(Duration since_start) { return Time(1000s + since_start); }
Time stamped(Duration since_start) { return Time(since_start); }

TEST(StampClock, OwnClockNeedsNoShift) {
  StampClock clock(ClockDomain::kMonotonic, 5s);
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(3s), at(0s)), Duration::zero());
}

TEST(StampClock, TimeOfDayIsShiftedByItsLead) {
  StampClock clock(ClockDomain::kRealtime, 5s);
  EXPECT_EQ(clock.shift(InputKind::kDepth, stamped(3s), at(0s)), -5s);
}

TEST(StampClock, LogIsShiftedAsItsTimeliestPoseOfTheBeginning) {
  StampClock clock(ClockDomain::kLog, 5s);
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
  StampClock clock(ClockDomain::kLog, 0s);
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
