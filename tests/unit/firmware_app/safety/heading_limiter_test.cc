#include "firmware_app/safety/heading_limiter.h"

#include <gtest/gtest.h>

#include "tests/unit/firmware_app/safety/healthy.h"

namespace nanomap {
namespace {

constexpr double kTolerance_rad = 1e-12;

TEST(HeadingLimiter, FirstHeadingIsTheWantedOne) {
  HeadingLimiter heading(1.0);
  EXPECT_EQ(heading.follow(atMs(0), 2.0), 2.0);
}

TEST(HeadingLimiter, TurnsNoFasterThanItMay) {
  HeadingLimiter heading(1.0);
  heading.reset(atMs(0), 0.0);
  EXPECT_NEAR(heading.follow(atMs(100), 2.0), 0.1, kTolerance_rad);
  EXPECT_NEAR(heading.follow(atMs(200), 2.0), 0.2, kTolerance_rad);
  EXPECT_NEAR(heading.follow(atMs(5000), 2.0), 2.0, kTolerance_rad);
}

TEST(HeadingLimiter, TurnsTheShorterWayRound) {
  HeadingLimiter heading(1.0);
  heading.reset(atMs(0), 3.0);
  EXPECT_NEAR(heading.follow(atMs(100), -3.0), 3.1, kTolerance_rad);
  EXPECT_NEAR(heading.follow(atMs(1000), -3.0), -3.0, kTolerance_rad);
}

TEST(HeadingLimiter, TimeThatGoesBackwardsTurnsNothing) {
  HeadingLimiter heading(1.0);
  heading.reset(atMs(1000), 0.5);
  EXPECT_NEAR(heading.follow(atMs(0), 2.0), 0.5, kTolerance_rad);
}

}  // namespace
}  // namespace nanomap
