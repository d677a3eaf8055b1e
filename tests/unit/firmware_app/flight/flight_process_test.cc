#include "firmware_app/flight/flight_process.h"

#include <gtest/gtest.h>

#include "tests/support/flight_log.h"
#include "tests/unit/firmware_app/flight/flown_log.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::FlownLog;
using test::logConfiguration;
using test::Watched;

std::filesystem::path smallFlight(std::int64_t duration_ms) {
  test::FlightLog log(test::testFile("flight"));
  log.camera(0);
  log.goal(0);
  log.fly(0, duration_ms);
  return log.close();
}

TEST(FlightProcess, BecomesReadyFliesByOrderAndBrakesWhenTheLogEnds) {
  FlownLog flight(smallFlight(6000), logConfiguration());
  const Watched before = flight.watch(3500ms);
  ASSERT_TRUE(before.states.contains(State::kReady)) << before.last.verdict.faults.words();
  EXPECT_FALSE(before.states.contains(State::kFlying));
  flight.autopilot.order();
  const Watched after = flight.watch(10s);
  EXPECT_TRUE(after.states.contains(State::kFlying)) << after.last.verdict.faults.words();
  sleepUntil(processNow() + 1s);
  EXPECT_EQ(flight.autopilot.status(), SystemStatus::kCritical);
  EXPECT_GT(flight.autopilot.targets(), 50U);
}

TEST(FlightProcess, StopsAtOnceWhateverItDoes) {
  for (int i = 0; i < 3; ++i) {
    FlownLog flight(smallFlight(1000), logConfiguration());
    (void)flight.watch(Duration(i * 100'000'000));
  }
}

}  // namespace
}  // namespace nanomap
