#include "firmware_app/realtime/memory_lock.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <memory>

#include "firmware_app/realtime/thread_usage.h"

namespace nanomap {
namespace {

constexpr std::size_t kBytes = std::size_t{64} << 20;

struct BlockFaults {
  std::int64_t allocation = 0;
  std::int64_t use = 0;
};

/// Page faults of a large block of memory.
BlockFaults faultsOfABlock() {
  ThreadUsageMeter meter;
  meter.sample();
  const ThreadUsage start = meter.last();
  const std::unique_ptr<volatile char[]> block(new volatile char[kBytes]);
  meter.sample();
  const ThreadUsage allocated = meter.last();
  for (std::size_t i = 0; i < kBytes; i += 1024) block[i] = 1;
  meter.sample();
  return {(allocated - start).faults(), (meter.last() - allocated).faults()};
}

/// Locks this process's memory. @return 0, or what went wrong
int tryLock() {
  const std::error_code refused = lockMemory();
  if (refused) return refused == std::errc::operation_not_permitted || refused == std::errc::not_enough_memory ? 0 : 1;
  if (faultsOfABlock().use != 0) return 2;
  return faultsOfABlock().allocation == 0 ? 0 : 3;
}

// In a process of its own: memory cannot be unlocked for the tests that follow in this one.
TEST(MemoryLockDeathTest, NeitherNewNorFreedMemoryFaultsWhenUsed) {
  if (!kLocksMemory) GTEST_SKIP() << "sanitizers reserve more than can be locked";
  EXPECT_EXIT(std::exit(tryLock()), ::testing::ExitedWithCode(0), "");
}

TEST(MemoryLock, DoesNothingUnderSanitizers) {
  if (kLocksMemory) GTEST_SKIP() << "not a build with sanitizers";
  EXPECT_FALSE(lockMemory());
}

}  // namespace
}  // namespace nanomap
