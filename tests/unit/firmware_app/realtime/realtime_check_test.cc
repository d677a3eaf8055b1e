#include "firmware_app/realtime/realtime_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr RealtimeNeeds kNeeds{.cores = 2, .locked_memory = true};

/// A machine that grants all there is.
RealtimeFacts grantingMachine() {
  return {.cores = {0, 1},
          .tried_priority = 45,
          .fifo_error = 0,
          .priority_limit = 99,
          .locked_memory_limit_bytes = std::nullopt,
          .may_schedule = false,
          .may_lock_memory = false,
          .realtime_share = std::nullopt,
          .realtime_period = 1s,
          .program = "/opt/nanomap/bin/nanomap-flight"};
}

/// The only finding about a machine.
RealtimeFinding findingOf(const RealtimeFacts& facts) {
  const auto findings = judgeRealtime(facts, kNeeds);
  EXPECT_THAT(findings, SizeIs(1));
  return findings.empty() ? RealtimeFinding{} : findings.front();
}

TEST(RealtimeCheck, MachineThatGrantsEverythingIsFound) {
  EXPECT_THAT(judgeRealtime(grantingMachine(), kNeeds), IsEmpty());
  EXPECT_TRUE(grantsRealtime({}));
  EXPECT_EQ(toText({}), "");
}

TEST(RealtimeCheck, TooFewCores) {
  RealtimeFacts facts = grantingMachine();
  facts.cores = {3};
  const RealtimeFinding finding = findingOf(facts);
  EXPECT_TRUE(finding.refusal);
  EXPECT_THAT(finding.reason, AllOf(HasSubstr("1 of"), HasSubstr("needs 2")));
  EXPECT_THAT(finding.fix, AllOf(HasSubstr("taskset"), HasSubstr("CPUAffinity=")));
}

TEST(RealtimeCheck, PriorityLimitIsNamedWithAllWaysOut) {
  RealtimeFacts facts = grantingMachine();
  facts.fifo_error = EPERM;
  facts.priority_limit = 0;
  const RealtimeFinding finding = findingOf(facts);
  EXPECT_TRUE(finding.refusal);
  EXPECT_THAT(finding.reason,
              AllOf(HasSubstr("priority 45"), HasSubstr("RLIMIT_RTPRIO is 0"), HasSubstr("CAP_SYS_NICE")));
  EXPECT_THAT(finding.fix, AllOf(HasSubstr("LimitRTPRIO="), HasSubstr("/etc/security/limits.d"), HasSubstr("rtprio 49"),
                                 HasSubstr("setcap cap_sys_nice,cap_ipc_lock=ep /opt/nanomap/bin/nanomap-flight")));
}

TEST(RealtimeCheck, LimitBelowTheWantedPriorityIsALimit) {
  RealtimeFacts facts = grantingMachine();
  facts.fifo_error = EPERM;
  facts.priority_limit = 44;
  EXPECT_THAT(findingOf(facts).reason, HasSubstr("RLIMIT_RTPRIO is 44"));
}

TEST(RealtimeCheck, RefusalInSpiteOfTheRightsIsAContainers) {
  for (const bool by_capability : {false, true}) {
    RealtimeFacts facts = grantingMachine();
    facts.fifo_error = EPERM;
    facts.priority_limit = by_capability ? 0 : 45;
    facts.may_schedule = by_capability;
    const RealtimeFinding finding = findingOf(facts);
    EXPECT_TRUE(finding.refusal);
    EXPECT_THAT(finding.reason, AllOf(HasSubstr("seccomp"), HasSubstr("CONFIG_RT_GROUP_SCHED")));
    EXPECT_THAT(finding.fix, AllOf(HasSubstr("--cap-add=SYS_NICE"), HasSubstr("cpu.rt_runtime_us")));
  }
}

TEST(RealtimeCheck, AnotherErrorIsTold) {
  RealtimeFacts facts = grantingMachine();
  facts.fifo_error = EINVAL;
  EXPECT_THAT(findingOf(facts).reason, HasSubstr("Invalid argument"));
}

TEST(RealtimeCheck, LimitOfLockedMemory) {
  RealtimeFacts facts = grantingMachine();
  facts.locked_memory_limit_bytes = 8'388'608;
  const RealtimeFinding finding = findingOf(facts);
  EXPECT_TRUE(finding.refusal);
  EXPECT_THAT(finding.reason, AllOf(HasSubstr("8388608 bytes"), HasSubstr("CAP_IPC_LOCK")));
  EXPECT_THAT(finding.fix, AllOf(HasSubstr("LimitMEMLOCK=infinity"), HasSubstr("memlock unlimited")));

  facts.may_lock_memory = true;
  EXPECT_THAT(judgeRealtime(facts, kNeeds), IsEmpty());
}

TEST(RealtimeCheck, MemoryThatNeedNotBeLockedMayBeLimited) {
  RealtimeFacts facts = grantingMachine();
  facts.locked_memory_limit_bytes = 0;
  EXPECT_THAT(judgeRealtime(facts, {.cores = 2, .locked_memory = false}), IsEmpty());
}

TEST(RealtimeCheck, ThrottlingIsGoodToKnowUnlessItIsTotal) {
  RealtimeFacts facts = grantingMachine();
  facts.realtime_share = 950ms;
  EXPECT_FALSE(findingOf(facts).refusal);
  EXPECT_THAT(findingOf(facts).reason, AllOf(HasSubstr("950 ms of every 1000 ms"), HasSubstr("sched_rt_runtime_us")));

  facts.realtime_share = 0ms;
  EXPECT_TRUE(findingOf(facts).refusal);
  EXPECT_THAT(findingOf(facts).fix, HasSubstr("sysctl -w kernel.sched_rt_runtime_us="));

  facts.realtime_share = 1s;
  EXPECT_THAT(judgeRealtime(facts, kNeeds), IsEmpty());
}

TEST(RealtimeCheck, OneRefusalAmongManyIsEnough) {
  RealtimeFacts facts = grantingMachine();
  facts.realtime_share = 950ms;
  EXPECT_TRUE(grantsRealtime(judgeRealtime(facts, kNeeds)));
  facts.cores.clear();
  facts.fifo_error = EPERM;
  facts.priority_limit = 0;
  facts.locked_memory_limit_bytes = 0;
  const auto findings = judgeRealtime(facts, kNeeds);
  EXPECT_THAT(findings, SizeIs(4));
  EXPECT_FALSE(grantsRealtime(findings));
  for (const RealtimeFinding& finding : findings) {
    EXPECT_THAT(toText(findings), AllOf(HasSubstr(finding.reason), HasSubstr(finding.fix)));
  }
}

}  // namespace
}  // namespace nanomap
