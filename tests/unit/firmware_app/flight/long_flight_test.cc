#include <gtest/gtest.h>

#include <map>
#include <string>

#include "firmware_app/realtime/memory_lock.h"
#include "tests/unit/firmware_app/flight/flown_log.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::FlownLog;
using test::logConfiguration;
using test::Watched;

// A minute of forest with the paper's camera. After start-up, here the time until the history is full twice over, the
// real-time threads get by with what they have.
TEST(FlightProcess, RealtimeThreadsNeitherAllocateNorFaultAfterStartUp) {
  if (lockMemory()) GTEST_SKIP() << "memory cannot be locked here: page faults say nothing";
  FlownLog flight(NANOMAP_LONG_FLIGHT, logConfiguration());
  (void)flight.watch(12s);
  EXPECT_FALSE(flight.process().sourceEnded()) << "the log is too short";
  flight.autopilot.order();
  struct Count {
    std::int64_t faults = 0;
    std::uint64_t allocations = 0;
  };
  std::map<std::string, Count> before;
  for (const Worker* worker : flight.process().workers()) {
    before[worker->settings().name] = {worker->usage().faults(), worker->allocations()};
  }
  const Watched watched = flight.watch(100s);
  EXPECT_GT(watched.decisions, 500U);  // of 1440, on a machine that does other things too
  for (const Worker* worker : flight.process().workers()) {
    if (!worker->settings().place) continue;
    const Count& count = before[worker->settings().name];
    EXPECT_EQ(worker->allocations(), count.allocations) << worker->settings().name;
    EXPECT_EQ(worker->usage().faults(), count.faults) << worker->settings().name;
  }
}

}  // namespace
}  // namespace nanomap
