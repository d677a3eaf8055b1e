#include "firmware_app/handover/doorbell.h"

#include <gtest/gtest.h>

#include <thread>

namespace nanomap {
namespace {

constexpr Duration kLong = std::chrono::seconds(20);

TEST(Doorbell, SilentOneLetsGoAtTheDeadline) {
  Doorbell bell;
  EXPECT_FALSE(bell.wait(Duration::zero()));
  EXPECT_FALSE(bell.wait(std::chrono::milliseconds(1)));
}

TEST(Doorbell, RingsBeforeTheWaitAddUpToOne) {
  Doorbell bell;
  bell.ring();
  bell.ring();
  EXPECT_TRUE(bell.wait(kLong));
  EXPECT_FALSE(bell.wait(Duration::zero()));
}

TEST(Doorbell, WakesAnotherThread) {
  Doorbell bell;
  std::thread ringer([&] { bell.ring(); });
  EXPECT_TRUE(bell.wait(kLong));
  ringer.join();
}

TEST(Doorbell, DeadlineAcrossTheSecondIsKept) {
  Doorbell bell;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(bell.wait(std::chrono::milliseconds(1001)));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(1000));
}

}  // namespace
}  // namespace nanomap
