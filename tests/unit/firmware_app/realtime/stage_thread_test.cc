#include "firmware_app/realtime/stage_thread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <vector>

#include "firmware_app/realtime/memory_lock.h"
#include "firmware_app/realtime/realtime_facts.h"
#include "firmware_app/realtime/thread_usage.h"

namespace nanomap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::ThrowsMessage;

constexpr int kPriority = 10;
constexpr int kNoSuchCore = CPU_SETSIZE - 1;

/// What a thread sees of itself.
struct Self {
  static Self now() {
    Self self;
    self.name.resize(16);
    pthread_getname_np(pthread_self(), self.name.data(), self.name.size());
    self.name.resize(self.name.find('\0'));
    sched_param parameters{};
    pthread_getschedparam(pthread_self(), &self.policy, &parameters);
    self.priority = parameters.sched_priority;
    sched_getaffinity(0, sizeof self.cores, &self.cores);
    pthread_sigmask(SIG_SETMASK, nullptr, &self.blocked);
    return self;
  }

  std::string name;
  int policy = -1;
  int priority = -1;
  cpu_set_t cores{};
  sigset_t blocked{};
};

Self selfOf(const ThreadSettings& settings) {
  Self self;
  {
    const StageThread thread(settings, [&](const std::stop_token&) { self = Self::now(); });
  }
  return self;
}

bool realtimeIsGranted() { return gatherRealtimeFacts(kPriority).fifo_error == 0; }

int firstCore() { return gatherRealtimeFacts(kPriority).cores.front(); }

TEST(StageThread, PlainThreadHasItsNameAndEveryCore) {
  const Self self = selfOf({.name = "ingest", .place = std::nullopt});
  EXPECT_EQ(self.name, "ingest");
  EXPECT_EQ(self.policy, SCHED_OTHER);
  const cpu_set_t all = Self::now().cores;
  EXPECT_TRUE(CPU_EQUAL(&self.cores, &all));
}

TEST(StageThread, RealtimeThreadIsInItsPlace) {
  if (!realtimeIsGranted()) GTEST_SKIP() << "this machine refuses real-time scheduling";
  const int core = gatherRealtimeFacts(kPriority).cores.back();
  const Self self = selfOf({.name = "planner", .place = ThreadPlace{core, kPriority}});
  EXPECT_EQ(self.policy, SCHED_FIFO);
  EXPECT_EQ(self.priority, kPriority);
  EXPECT_EQ(CPU_COUNT(&self.cores), 1);
  EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(core), &self.cores));
}

TEST(StageThread, PlainThreadMadeByARealtimeOneIsPlain) {
  if (!realtimeIsGranted()) GTEST_SKIP() << "this machine refuses real-time scheduling";
  Self self;
  {
    const StageThread maker({.name = "maker", .place = ThreadPlace{firstCore(), kPriority}},
                            [&](const std::stop_token&) { self = selfOf({.name = "made", .place = std::nullopt}); });
  }
  EXPECT_EQ(self.policy, SCHED_OTHER);
  const cpu_set_t all = Self::now().cores;
  EXPECT_TRUE(CPU_EQUAL(&self.cores, &all));
}

TEST(StageThread, PlaceThatIsRefusedStopsTheStartBeforeTheBody) {
  std::atomic<bool> ran = false;
  EXPECT_THAT(
      [&] {
        const StageThread thread({.name = "index", .place = ThreadPlace{kNoSuchCore, kPriority}},
                                 [&](const std::stop_token&) { ran = true; });
      },
      ThrowsMessage<std::runtime_error>(AllOf(
          HasSubstr("thread index"), HasSubstr("core " + std::to_string(kNoSuchCore)), HasSubstr("LimitRTPRIO="))));
  EXPECT_FALSE(ran);
}

TEST(StageThread, PlaceThatNeedNotBeGrantedIsTakenAsFarAsItIs) {
  Self self;
  std::optional<std::string> refusal;
  {
    const StageThread thread({.name = "index", .place = ThreadPlace{kNoSuchCore, kPriority}, .demand_realtime = false},
                             [&](const std::stop_token&) { self = Self::now(); });
    refusal = thread.refusal();
  }
  EXPECT_THAT(refusal, Optional(HasSubstr("core " + std::to_string(kNoSuchCore))));
  EXPECT_EQ(self.name, "index");
  EXPECT_EQ(self.policy, realtimeIsGranted() ? SCHED_FIFO : SCHED_OTHER);
}

/// Takes the capability to schedule from the calling thread and those that it makes. @return whether that works
bool giveUpScheduling() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  if (syscall(SYS_capget, &header, sets.data()) != 0) return false;
  sets[0].effective &= ~(1U << CAP_SYS_NICE);
  return syscall(SYS_capset, &header, sets.data()) == 0;
}

TEST(StageThread, WithoutTheRightToSchedulingSaysWhereItComesFrom) {
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_RTPRIO, &limit), 0);
  if (limit.rlim_cur >= kPriority) GTEST_SKIP() << "the limit grants it to everyone here";
  const int core = firstCore();
  std::string message;
  std::optional<std::string> refusal;
  Self self;
  std::thread([&] {
    ASSERT_TRUE(giveUpScheduling());
    const StageThread lenient({.name = "chain", .place = ThreadPlace{core, kPriority}, .demand_realtime = false},
                              [&](const std::stop_token&) { self = Self::now(); });
    refusal = lenient.refusal();
    try {
      const StageThread strict({.name = "chain", .place = ThreadPlace{core, kPriority}}, [](const std::stop_token&) {});
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
  }).join();
  EXPECT_THAT(message, AllOf(HasSubstr("thread chain is refused SCHED_FIFO priority 10 (Operation not permitted)"),
                             HasSubstr("limits.d"), HasSubstr("setcap")));
  EXPECT_THAT(refusal, Optional(HasSubstr("SCHED_FIFO")));
  EXPECT_EQ(self.policy, SCHED_OTHER);
  EXPECT_EQ(CPU_COUNT(&self.cores), 1) << "it may be pinned all the same";
}

TEST(StageThread, EndIsAStopThatIsWaitedFor) {
  std::atomic<bool> ended = false;
  {
    const StageThread thread({.name = "health", .place = std::nullopt}, [&](const std::stop_token& stop) {
      while (!stop.stop_requested()) std::this_thread::yield();
      ended = true;
    });
  }
  EXPECT_TRUE(ended);
}

TEST(StageThread, StopCanBeRequestedOfAllBeforeAnyIsWaitedFor) {
  std::atomic<int> stopped = 0;
  const auto body = [&](const std::stop_token& stop) {
    while (!stop.stop_requested()) std::this_thread::yield();
    ++stopped;
    while (stopped < 2) std::this_thread::yield();
  };
  StageThread first({.name = "first", .place = std::nullopt}, body);
  StageThread second({.name = "second", .place = std::nullopt}, body);
  first.requestStop();
  second.requestStop();
}

TEST(StageThread, LeavesSignalsToOthersExceptItsOwnFaults) {
  const Self self = selfOf({.name = "capture", .place = std::nullopt});
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
    EXPECT_EQ(sigismember(&self.blocked, signal), 1) << signal;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT})
    EXPECT_EQ(sigismember(&self.blocked, signal), 0) << signal;
}

TEST(StageThread, StackIsThereBeforeItIsUsed) {
  if (!kLocksMemory) GTEST_SKIP() << "sanitizers' own memory faults";
  constexpr std::size_t kUsed = kDefaultStackBytes / 4 * 3;
  std::int64_t faults = -1;
  {
    const StageThread thread({.name = "stack", .place = std::nullopt}, [&](const std::stop_token&) {
      ThreadUsageMeter meter;
      meter.sample();  // and the code that follows is there
      meter.sample();
      const ThreadUsage before = meter.last();
      std::array<volatile char, kUsed> deep;
      for (std::size_t i = 0; i < kUsed; i += 1024) deep[kUsed - 1 - i] = 1;
      meter.sample();
      faults = (meter.last() - before).faults();
    });
  }
  EXPECT_EQ(faults, 0);
}

TEST(StageThread, UnfitSettingsAreNamed) {
  const auto start = [](const ThreadSettings& settings) {
    return [=] { const StageThread thread(settings, [](const std::stop_token&) {}); };
  };
  EXPECT_THAT(start({.name = "", .place = std::nullopt}), ThrowsMessage<std::invalid_argument>(HasSubstr("name ''")));
  EXPECT_THAT(start({.name = "sixteen_letters_", .place = std::nullopt}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("sixteen_letters_")));
  EXPECT_THAT(start({.name = "small", .place = std::nullopt, .stack_bytes = 4096}),
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("small"), HasSubstr("4096"))));
}

}  // namespace
}  // namespace nanomap
