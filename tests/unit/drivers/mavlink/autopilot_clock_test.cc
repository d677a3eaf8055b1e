#include "drivers/mavlink/autopilot_clock.h"

#include <gtest/gtest.h>

#include <random>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Time kBoot = Time(1000s);

TEST(AutopilotClock, TakesTheFirstMessageForUndelayed) {
  AutopilotClock clock;
  EXPECT_EQ(clock.toOurs(5000, kBoot + 5010ms), kBoot + 5010ms);
}

TEST(AutopilotClock, TellsTheAutopilotsTime) {
  AutopilotClock clock;
  EXPECT_FALSE(clock.toTheirs(kBoot));
  (void)clock.toOurs(5000, kBoot + 5s);
  EXPECT_EQ(clock.toTheirs(kBoot + 4s), 4s);
  EXPECT_FALSE(clock.toTheirs(kBoot - 1ns));
}

TEST(AutopilotClock, IsRightToTheLeastDelay) {
  AutopilotClock clock;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> delay_ms(2, 60);
  for (std::uint32_t ms = 0; ms < 60'000; ms += 20) {
    const Time stamped = kBoot + std::chrono::milliseconds(ms);
    const Time ours = clock.toOurs(ms, stamped + std::chrono::milliseconds(delay_ms(random)));
    if (ms < 2000) continue;
    EXPECT_GE(ours, stamped + 2ms);
    EXPECT_LE(ours, stamped + 5ms);
  }
}

TEST(AutopilotClock, FollowsADriftingClock) {
  AutopilotClock clock;
  Duration error{};
  for (std::uint32_t ms = 0; ms < 600'000; ms += 20) {
    // Its milliseconds are longer than ours: what it stamps falls behind.
    const Time truth = kBoot + std::chrono::microseconds(static_cast<std::int64_t>(ms) * 1000 * 10'001 / 10'000);
    error = truth - clock.toOurs(ms, truth);
  }
  EXPECT_LE(error, 3ms);  // 60 ms without
  EXPECT_GE(error, 0ms);
}

TEST(AutopilotClock, StartsAnewWhenTheAutopilotReboots) {
  AutopilotClock clock;
  (void)clock.toOurs(100'000, kBoot + 100s);
  EXPECT_EQ(clock.toOurs(200, kBoot + 120s), kBoot + 120s);
  EXPECT_EQ(clock.toOurs(220, kBoot + 120'120ms), kBoot + 120'020ms);
}

TEST(AutopilotClock, SurvivesTheWrapAfterFortyNineDays) {
  AutopilotClock clock;
  (void)clock.toOurs(4'294'967'290U, kBoot);
  EXPECT_EQ(clock.toOurs(4, kBoot + 10ms), kBoot + 10ms);
}

TEST(AutopilotClock, SurvivesOurTimeGoingBackwards) {
  AutopilotClock clock;
  (void)clock.toOurs(5000, kBoot);
  EXPECT_EQ(clock.toOurs(5020, kBoot - 10s), kBoot - 10s);
}

}  // namespace
}  // namespace nanomap
