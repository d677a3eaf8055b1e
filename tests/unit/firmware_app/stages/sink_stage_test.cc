#include "firmware_app/stages/sink_stage.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/firmware_app/stages/flight_on_a_fake_clock.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::FlightOnAFakeClock;
using test::ObedientAutopilot;

bool wasTold(const ObedientAutopilot& autopilot, const std::string& words) {
  return std::any_of(autopilot.texts.begin(), autopilot.texts.end(),
                     [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

TEST(SinkStage, TellsThePilotWhatHappens) {
  FlightOnAFakeClock flight;
  flight.run(4s);
  EXPECT_TRUE(wasTold(flight.autopilot, "waits for"));
  EXPECT_TRUE(wasTold(flight.autopilot, "ready"));
  flight.order();
  flight.run(1s);
  EXPECT_TRUE(wasTold(flight.autopilot, "flies"));
  flight.breakIt(test::Broken::kDepth, test::How::kOff);
  flight.run(1s);
  EXPECT_TRUE(wasTold(flight.autopilot, "still without: depth images"));
  EXPECT_LT(flight.autopilot.texts.size(), 8U);
}

TEST(SinkStage, TellsOfObstaclesTenTimesASecondAndOfNoOdometryUnlessAsked) {
  FlightOnAFakeClock flight;
  flight.run(5s);
  EXPECT_NEAR(static_cast<double>(flight.autopilot.obstacles), 50.0, 10.0);
  EXPECT_EQ(flight.autopilot.odometries, 0U);
}

TEST(SinkStage, ForwardsPosesAtFiftyHertzWhenAsked) {
  Configuration configuration = FlightOnAFakeClock::configuration();
  configuration.mavlink.send_odometry = true;
  FlightOnAFakeClock flight(configuration);
  flight.run(5s);
  EXPECT_NEAR(static_cast<double>(flight.autopilot.odometries), 250.0, 10.0);
}

TEST(SinkStage, RecordingIsNeverFlownWithALiveAutopilot) {
  Configuration configuration = FlightOnAFakeClock::configuration();
  configuration.lcm.clock = ClockDomain::kLog;
  configuration.mavlink.send_odometry = true;
  FlightOnAFakeClock flight(configuration);
  flight.run(5s);
  flight.order();
  flight.run(2s);
  EXPECT_EQ(flight.state(), State::kWaiting);
  EXPECT_EQ(flight.autopilot.targets, 0U);
  EXPECT_EQ(flight.autopilot.odometries, 0U);
  EXPECT_EQ(flight.autopilot.obstacles, 0U);
  EXPECT_TRUE(wasTold(flight.autopilot, "a log is never flown"));
}

TEST(SinkStage, RecordingIsFlownWithASimulatedAutopilot) {
  Configuration configuration = FlightOnAFakeClock::configuration();
  configuration.lcm.clock = ClockDomain::kLog;
  FlightOnAFakeClock flight(configuration);
  flight.autopilot.state.simulated = true;
  flight.run(5s);
  flight.order();
  flight.run(2s);
  EXPECT_EQ(flight.state(), State::kFlying);
}

TEST(SinkStage, TellsMotionsAheadByWhatTheVehicleIsBehind) {
  Configuration configuration = FlightOnAFakeClock::configuration();
  configuration.mavlink.feedforward = {.setpoint_lead = 50ms, .tilt_lag = 200ms, .drag_1_s = 0.7};
  FlightOnAFakeClock flight(configuration);
  flight.run(5s);
  flight.order();
  flight.run(2s);
  std::size_t moving = 0;
  for (const SentSetpoint& sent : flight.setpoints()) {
    if (!sent.motion || !sent.motion->decision) continue;
    const MadeDecision* made = flight.decision(*sent.motion->decision);
    ASSERT_TRUE(made);
    const Motion expected_W = configuration.mavlink.feedforward.sample(made->decision.brake, sent.stamp);
    EXPECT_EQ(sent.motion->motion_W.position_m, expected_W.position_m);
    EXPECT_EQ(sent.motion->motion_W.acceleration_m_s2, expected_W.acceleration_m_s2);
    if (expected_W.velocity_m_s.norm() > 1.0) ++moving;
  }
  EXPECT_GT(moving, 20U);
}

}  // namespace
}  // namespace nanomap
