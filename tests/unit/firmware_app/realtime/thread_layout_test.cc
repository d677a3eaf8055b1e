#include "firmware_app/realtime/thread_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

namespace nanomap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using enum RealtimeThread;

std::vector<int> coresUpTo(int count) {
  std::vector<int> cores(static_cast<std::size_t>(count));
  std::iota(cores.begin(), cores.end(), 0);
  return cores;
}

std::vector<int> coresOf(const ThreadLayout& layout) {
  std::vector<int> cores;
  for (const ThreadPlace& place : layout.places) cores.push_back(place.core);
  return cores;
}

TEST(ThreadLayout, OnTwoCoresCaptureSharesWithIndexAndChainWithPlanner) {
  EXPECT_EQ(coresOf(defaultLayout(coresUpTo(2))), (std::vector<int>{0, 0, 1, 1, 0}));
  EXPECT_EQ(defaultLayout(coresUpTo(3)), defaultLayout(coresUpTo(2)));
}

TEST(ThreadLayout, OnFourCoresEachStageHasItsOwn) {
  EXPECT_EQ(coresOf(defaultLayout(coresUpTo(4))), (std::vector<int>{0, 1, 2, 3, 0}));
  EXPECT_EQ(defaultLayout(coresUpTo(7)), defaultLayout(coresUpTo(4)));
}

TEST(ThreadLayout, OnEightCoresTheFirstOnesAreLeftToTheOthers) {
  EXPECT_EQ(coresOf(defaultLayout(coresUpTo(8))), (std::vector<int>{4, 5, 6, 7, 3}));
  EXPECT_EQ(defaultLayout(coresUpTo(64)), defaultLayout(coresUpTo(8)));
}

TEST(ThreadLayout, UsesOnlyTheCoresOfTheProcess) {
  EXPECT_EQ(coresOf(defaultLayout(std::vector{3})), (std::vector<int>{3, 3, 3, 3, 3}));
  EXPECT_EQ(coresOf(defaultLayout(std::vector{1, 6})), (std::vector<int>{1, 1, 6, 6, 1}));
}

TEST(ThreadLayout, DefaultsPassTheCheckOnEveryMachine) {
  for (int count = 1; count <= 20; ++count) {
    const std::vector<int> cores = coresUpTo(count);
    EXPECT_NO_THROW(checkLayout(defaultLayout(cores), cores)) << count << " cores";
  }
}

TEST(ThreadLayout, WatchdogGoesFirstThenTheShorterWork) {
  const ThreadLayout layout = defaultLayout(coresUpTo(4));
  EXPECT_EQ(layout.highestPriority(), layout[kWatchdog].priority);
  EXPECT_LT(layout[kWatchdog].priority, kInterruptPriority);
  EXPECT_GT(layout[kWatchdog].priority, layout[kCapture].priority);
  EXPECT_GT(layout[kCapture].priority, layout[kChain].priority);
  EXPECT_GT(layout[kChain].priority, layout[kIndex].priority);
  EXPECT_GT(layout[kIndex].priority, layout[kPlanner].priority);
}

TEST(ThreadLayout, CoreThatThereIsNotIsNamed) {
  const std::vector<int> cores{1, 3};
  for (const int core : {-1, 0, 2, 4}) {
    ThreadLayout layout = defaultLayout(cores);
    layout[kPlanner].core = core;
    EXPECT_THAT([&] { checkLayout(layout, cores); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("realtime.planner_core is " + std::to_string(core)), HasSubstr("1, 3"))));
  }
}

TEST(ThreadLayout, PriorityOutOfRangeIsNamed) {
  for (const int priority : {-1, 0, kInterruptPriority, 99}) {
    ThreadLayout layout = defaultLayout(coresUpTo(2));
    layout[kCapture].priority = priority;
    EXPECT_THAT([&] { checkLayout(layout, coresUpTo(2)); },
                ThrowsMessage<std::invalid_argument>(AllOf(
                    HasSubstr("realtime.capture_priority is " + std::to_string(priority)), HasSubstr("1 .. 49"))));
  }
}

TEST(ThreadLayout, NothingHidesFromTheWatchdog) {
  ThreadLayout layout = defaultLayout(coresUpTo(2));
  layout[kChain].priority = layout[kWatchdog].priority;
  EXPECT_THAT([&] { checkLayout(layout, coresUpTo(2)); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("realtime.chain_priority"), HasSubstr("realtime.watchdog_priority"))));
}

TEST(ThreadLayout, EveryThreadHasAName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kRealtimeThreadCount; ++i) names.insert(toString(static_cast<RealtimeThread>(i)));
  EXPECT_EQ(names.size(), kRealtimeThreadCount);
  EXPECT_FALSE(names.contains("?"));
}

}  // namespace
}  // namespace nanomap
