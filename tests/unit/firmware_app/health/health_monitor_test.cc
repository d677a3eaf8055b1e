#include "firmware_app/health/health_monitor.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

std::optional<std::int64_t> counter(const health_t& health, const std::string& name) {
  const auto found = std::find_if(health.counters.begin(), health.counters.end(),
                                  [&](const counter_t& each) { return each.name == name; });
  if (found == health.counters.end()) return std::nullopt;
  return found->value;
}

class HealthMonitorTest : public ::testing::Test {
 protected:
  void setSink(State state, Reason reason) {
    hand_overs_.sink_report.put([&](SinkReport& report) {
      report.verdict.state = state;
      report.reason = reason;
      report.depth_age = 61ms;
      report.pose_age = 8ms;
      report.counters.setpoints = 42;
    });
  }

  HandOvers hand_overs_{1};
  HealthMonitor monitor_{hand_overs_};
};

TEST_F(HealthMonitorTest, BeforeAnythingHappenedNothingIsKnown) {
  const health_t health = monitor_.report(Time(5s), {});
  EXPECT_EQ(health.utime, 5'000'000);
  EXPECT_EQ(health.state, "waiting");
  EXPECT_TRUE(std::isnan(health.depth_age));
  EXPECT_EQ(counter(health, "depth frames"), 0);
  EXPECT_THAT(statusLine(health), HasSubstr("depth none"));
}

TEST_F(HealthMonitorTest, LatenciesAreThoseSinceTheLastReport) {
  for (int i = 0; i < 10; ++i) hand_overs_.plan_times.push([](Duration& slot) { slot = 2ms; });
  const auto plan_of = [](const health_t& health) {
    return *std::find_if(health.latencies.begin(), health.latencies.end(),
                         [](const latency_t& latency) { return latency.name == "plan"; });
  };
  const latency_t first = plan_of(monitor_.report(Time(1s), {}));
  EXPECT_EQ(first.count, 10);
  EXPECT_NEAR(first.p50, 2e-3, 5e-5);
  EXPECT_NEAR(first.max, 2e-3, 1e-9);
  EXPECT_EQ(plan_of(monitor_.report(Time(2s), {})).count, 0);
}

TEST_F(HealthMonitorTest, WhyItHoversIsSaidWithWhatRefusedTheMotions) {
  setSink(State::kFlying, Reason::kBlocked);
  hand_overs_.newest_decision.put([](MadeDecision& made) {
    made.decision.evaluated = 125;
    made.decision.feasible = 3;
    made.decision.vetoes.by_neighbours = 100;
    made.decision.vetoes.by_status[static_cast<std::size_t>(Status::kOccluded)] = 22;
  });
  const health_t health = monitor_.report(Time(1s), {});
  EXPECT_EQ(health.state, "flying");
  EXPECT_THAT(health.reason, HasSubstr("122 of 125 motions refused"));
  EXPECT_THAT(health.reason, HasSubstr("too near 100"));
  EXPECT_THAT(health.reason, HasSubstr("occluded 22"));
  EXPECT_THAT(statusLine(health), HasSubstr("depth 61 ms, pose 8 ms"));
}

TEST_F(HealthMonitorTest, FaultsAreListedOnceTheyHappened) {
  EXPECT_FALSE(counter(monitor_.report(Time(1s), {}), "poses: ahead of our clock"));
  hand_overs_.ingest_counters.put(
      [](IngestCounters& counters) { counters.from_future[static_cast<std::size_t>(InputKind::kPose)] = 3; });
  EXPECT_EQ(counter(monitor_.report(Time(2s), {}), "poses: ahead of our clock"), 3);
}

TEST_F(HealthMonitorTest, DropsAreInTheStatusLine) {
  EXPECT_THAT(statusLine(monitor_.report(Time(1s), {})), Not(HasSubstr("dropped")));
  for (std::size_t i = 0; i <= hand_overs_.captured.capacity(); ++i) hand_overs_.captured.push([](ArrivedFrame&) {});
  EXPECT_THAT(statusLine(monitor_.report(Time(2s), {})), HasSubstr("dropped 1"));
}

TEST_F(HealthMonitorTest, WhatWasLostOnTheWayHereIsToldByStreamAndInTheStatusLine) {
  EXPECT_THAT(statusLine(monitor_.report(Time(1s), {})), Not(HasSubstr("lost")));
  hand_overs_.ingest_counters.put([](IngestCounters& counters) {
    counters.loss[static_cast<std::size_t>(InputKind::kDepth)].missing = 10;
    counters.loss[static_cast<std::size_t>(InputKind::kPose)].suspected = 2;
  });
  const health_t health = monitor_.report(Time(2s), {{std::string(kLostDatagrams), 33}});
  EXPECT_EQ(counter(health, "depth frames: missing"), 10);
  EXPECT_EQ(counter(health, "poses: suspected missing"), 2);
  EXPECT_THAT(statusLine(health), HasSubstr("lost: depth frames 10, poses 2, datagrams 33"));
}

TEST_F(HealthMonitorTest, LateFramesAStuckCameraAndASetClockAreTold) {
  hand_overs_.chain_counters.put([](ChainStageCounters& counters) { counters.stuck_views = 5; });
  hand_overs_.ingest_counters.put([](IngestCounters& counters) {
    counters.clock_steps = 1;
    counters.last_clock_step = -2s;
  });
  const health_t health = monitor_.report(Time(1s), {{std::string(kLateFrames), 4}});
  EXPECT_EQ(counter(health, "views: of a camera that is stuck"), 5);
  EXPECT_THAT(statusLine(health), HasSubstr("late frames 4 | time of day set 1 x, by -2000 ms"));
}

TEST_F(HealthMonitorTest, AllThatWasCountedFitsALine) {
  setSink(State::kFlying, Reason::kFlying);
  const std::string line = countersLine(monitor_.report(Time(1s), {{"late setpoints", 7}, {"others", 0}}));
  EXPECT_THAT(line, HasSubstr("setpoints 42, "));
  EXPECT_THAT(line, HasSubstr("late setpoints 7"));
  EXPECT_THAT(line, Not(HasSubstr("others")));
}

TEST_F(HealthMonitorTest, OthersAreShownAsTheyAre) {
  EXPECT_EQ(counter(monitor_.report(Time(1s), {{"late setpoints", 7}}), "late setpoints"), 7);
}

}  // namespace
}  // namespace nanomap
