#include "firmware_app/supervision/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace nanomap {
namespace {

TEST(Progress, IsStartingUntilItTells) { EXPECT_EQ(Progress().read(), (Progress::Reading{Activity::kStarting, 0})); }

TEST(Progress, TellsTheSameTwiceAsAChange) {
  Progress progress;
  progress.working();
  EXPECT_EQ(progress.read(), (Progress::Reading{Activity::kWorking, 1}));
  progress.working();
  EXPECT_EQ(progress.read(), (Progress::Reading{Activity::kWorking, 2}));
  progress.waiting();
  EXPECT_EQ(progress.read(), (Progress::Reading{Activity::kWaiting, 3}));
  progress.ended();
  EXPECT_EQ(progress.read(), (Progress::Reading{Activity::kEnded, 4}));
}

TEST(Progress, ReadsActivityAndCountTogether) {
  Progress progress;
  constexpr std::uint64_t kRounds = 20'000;
  std::thread teller([&] {
    for (std::uint64_t i = 0; i < kRounds; ++i) {
      progress.working();
      progress.waiting();
    }
    progress.ended();
  });
  Progress::Reading last;
  do {
    const Progress::Reading reading = progress.read();
    EXPECT_GE(reading.times_told, last.times_told);
    const bool odd = reading.times_told % 2 == 1;
    EXPECT_EQ(reading.activity == Activity::kWaiting || reading.activity == Activity::kStarting, !odd);
    last = reading;
  } while (last.activity != Activity::kEnded);
  teller.join();
  EXPECT_EQ(last.times_told, 2 * kRounds + 1);
}

}  // namespace
}  // namespace nanomap
