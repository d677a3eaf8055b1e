#include "firmware_app/flight/frame_deadline.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Time kArrival = Time(5s);

TEST(FrameDeadline, CountsAFrameThatWasDoneWithTooLateOnce) {
  FrameDeadline deadline(33ms);
  deadline.done(kArrival, kArrival + 34ms);
  deadline.done(kArrival, kArrival + 40ms);
  EXPECT_EQ(deadline.missed(), 1U);
}

TEST(FrameDeadline, FrameThatWasInTimeStaysSo) {
  FrameDeadline deadline(33ms);
  deadline.done(kArrival, kArrival + 33ms);
  deadline.done(kArrival, kArrival + 10s);
  EXPECT_EQ(deadline.missed(), 0U);
  deadline.done(kArrival + 33ms, kArrival + 99ms);
  EXPECT_EQ(deadline.missed(), 1U);
}

TEST(FrameDeadline, NoFrameYetIsNotLate) {
  FrameDeadline deadline(33ms);
  deadline.done(Time{}, kArrival);
  EXPECT_EQ(deadline.missed(), 0U);
}

}  // namespace
}  // namespace nanomap
