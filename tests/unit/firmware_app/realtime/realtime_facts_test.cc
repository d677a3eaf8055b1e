#include "firmware_app/realtime/realtime_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <thread>

namespace nanomap {
namespace {

using ::testing::EndsWith;

constexpr int kLockMemory = 14;  // capabilities(7): CAP_IPC_LOCK
constexpr int kScheduling = 23;  // CAP_SYS_NICE

TEST(HasCapability, IsABitOfTheEffectiveSet) {
  const std::string status =
      "Name:\tx\nCapPrm:\tffffffffffffffff\nCapEff:\t0000000000804000\nCapBnd:\tffffffffffffffff\n";
  EXPECT_TRUE(hasCapability(status, kLockMemory));
  EXPECT_TRUE(hasCapability(status, kScheduling));
  EXPECT_FALSE(hasCapability(status, 0));
  EXPECT_FALSE(hasCapability(status, kScheduling + 1));
}

TEST(HasCapability, OfTextThatDoesNotSayIsNone) {
  EXPECT_FALSE(hasCapability("", kScheduling));
  EXPECT_FALSE(hasCapability("CapEff:\t", kScheduling));
  EXPECT_FALSE(hasCapability("CapEff:\tno number\n", kScheduling));
}

TEST(RealtimeFacts, AreThoseOfThisProcess) {
  const RealtimeFacts facts = gatherRealtimeFacts(1);
  EXPECT_EQ(facts.cores.size(), std::thread::hardware_concurrency());
  EXPECT_TRUE(std::is_sorted(facts.cores.begin(), facts.cores.end()));
  EXPECT_THAT(facts.program, EndsWith("realtime_test"));
  EXPECT_TRUE(facts.fifo_error == 0 || facts.fifo_error == EPERM) << facts.fifo_error;
}

TEST(RealtimeFacts, TrialLeavesTheCallerAsItWas) {
  (void)gatherRealtimeFacts(10);
  int policy = -1;
  sched_param parameters{};
  ASSERT_EQ(pthread_getschedparam(pthread_self(), &policy, &parameters), 0);
  EXPECT_EQ(policy, SCHED_OTHER);
}

TEST(RealtimeFacts, PriorityThatDoesNotExistIsAnError) { EXPECT_EQ(gatherRealtimeFacts(100).fifo_error, EINVAL); }

}  // namespace
}  // namespace nanomap
