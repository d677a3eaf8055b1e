#include "firmware_app/realtime/thread_usage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace nanomap {
namespace {

constexpr int kPages = 64;

/// Touches that many pages for the first time.
void touchNewPages() {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory = mmap(nullptr, kPages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory");
  auto* const bytes = static_cast<volatile char*>(memory);
  for (std::size_t i = 0; i < kPages; ++i) bytes[i * page] = 1;
  munmap(memory, kPages * page);
}

TEST(ThreadUsage, IsZeroBeforeTheFirstSample) { EXPECT_EQ(ThreadUsageMeter().last(), ThreadUsage()); }

TEST(ThreadUsage, CountsTheFaultsOfTheThreadThatSamples) {
  ThreadUsageMeter meter;
  meter.sample();
  const ThreadUsage before = meter.last();
  touchNewPages();
  EXPECT_EQ(meter.last(), before) << "not sampled yet";
  meter.sample();
  const ThreadUsage used = meter.last() - before;
  EXPECT_GE(used.minor_faults, kPages);
  EXPECT_EQ(used.faults(), used.minor_faults + used.major_faults);
}

TEST(ThreadUsage, LeavesOtherThreadsOut) {
  ThreadUsageMeter meter;
  std::thread other;
  meter.sample();
  const ThreadUsage before = meter.last();
  other = std::thread(touchNewPages);
  other.join();
  meter.sample();
  EXPECT_LT((meter.last() - before).minor_faults, kPages) << "making a thread costs a few";
}

TEST(ThreadUsage, CountsWaits) {
  ThreadUsageMeter meter;
  meter.sample();
  const ThreadUsage before = meter.last();
  constexpr int kWaits = 5;
  for (int i = 0; i < kWaits; ++i) usleep(100);
  meter.sample();
  EXPECT_GE((meter.last() - before).voluntary_switches, kWaits);
}

}  // namespace
}  // namespace nanomap
