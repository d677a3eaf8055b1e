#include "drivers/mavlink/autopilot_monitor.h"

#include <gtest/gtest.h>

#include <numbers>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart = Time(50s);
constexpr HeartbeatMessage kPx4Hold{12, 1 | 128, 4U << 16 | 3U << 24};
constexpr HeartbeatMessage kPx4Offboard{12, 1 | 128, 6U << 16};
constexpr HeartbeatMessage kCopterLoiter{3, 1, 5, 2};
constexpr HeartbeatMessage kCopterGuided{3, 1, 4, 2};

AutopilotMonitor monitor() { return AutopilotMonitor(3s); }

AttitudeMessage facing(double heading_rad, std::uint32_t ms) {
  return {ms, Quat(Eigen::AngleAxisd(heading_rad, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(0.6, Vec3::UnitY())),
          Vec3::Zero()};
}

TEST(AutopilotMonitor, HasNotHeardOfAnAutopilotAtFirst) {
  const AutopilotState state = monitor().state(kStart);
  EXPECT_FALSE(state.linked);
  EXPECT_FALSE(state.heartbeat_age);
  EXPECT_EQ(state.kind, AutopilotKind::kUnknown);
}

TEST(AutopilotMonitor, LinkLivesAsLongAsItsHeartbeat) {
  AutopilotMonitor monitor = nanomap::monitor();
  monitor.receive(kPx4Hold, kStart);
  EXPECT_TRUE(monitor.state(kStart + 2999ms).linked);
  EXPECT_FALSE(monitor.state(kStart + 3s).linked);
  EXPECT_EQ(monitor.state(kStart + 3s).heartbeat_age, 3s);
  EXPECT_TRUE(monitor.state(kStart + 3s).armed);  // its last word
}

TEST(AutopilotMonitor, KnowsTheModeThatObeysSetpoints) {
  AutopilotMonitor monitor = nanomap::monitor();
  const auto obeys = [&](const HeartbeatMessage& heartbeat) {
    monitor.receive(heartbeat, kStart);
    return monitor.state(kStart).external_control;
  };
  EXPECT_FALSE(obeys(kPx4Hold));
  EXPECT_TRUE(obeys(kPx4Offboard));
  EXPECT_EQ(monitor.state(kStart).kind, AutopilotKind::kPx4);
  EXPECT_FALSE(obeys(kCopterLoiter));
  EXPECT_TRUE(obeys(kCopterGuided));
  EXPECT_EQ(monitor.state(kStart).kind, AutopilotKind::kArduPilot);
  EXPECT_FALSE(obeys({3, 0, 4, 2}));        // no custom mode
  EXPECT_FALSE(obeys({3, 1, 6 << 16, 2}));  // the other one's number
  const auto guides = [&](std::uint8_t type) { return obeys({3, 1, 4, type}); };
  for (std::uint8_t type = 0; type < 50; ++type) {
    const bool copter = type == 2 || type == 3 || type == 4 || (type >= 13 && type <= 15) || type == 29 || type == 35;
    EXPECT_EQ(guides(type), copter) << "a plane, a rover and a boat number their modes otherwise: " << int{type};
  }
  EXPECT_FALSE(obeys({12, 1, 4}));
  EXPECT_FALSE(obeys({0, 1, 6 << 16}));
}

TEST(AutopilotMonitor, CountsSwitchesToExternalControlThatItSaw) {
  AutopilotMonitor monitor = nanomap::monitor();
  const auto entriesAfter = [&](const HeartbeatMessage& heartbeat, Duration when) {
    monitor.receive(heartbeat, kStart + when);
    return monitor.state(kStart + when).external_control_entries;
  };
  EXPECT_EQ(entriesAfter(kPx4Offboard, 0s), 0U);  // it was so already when we started
  EXPECT_EQ(entriesAfter(kPx4Offboard, 1s), 0U);
  EXPECT_EQ(entriesAfter(kPx4Hold, 2s), 0U);
  EXPECT_EQ(entriesAfter(kPx4Offboard, 3s), 1U);
  EXPECT_EQ(entriesAfter(kPx4Hold, 4s), 1U);
  EXPECT_EQ(entriesAfter(kPx4Offboard, 14s), 1U);  // the link was lost: nobody knows when the pilot switched
}

TEST(AutopilotMonitor, JoinsPositionAndAttitude) {
  AutopilotMonitor monitor = nanomap::monitor();
  const LocalPositionMessage position{1000, {1.0, 2.0, -3.0}, Vec3::Zero()};
  monitor.receive(position, kStart);
  EXPECT_FALSE(monitor.takePose());
  EXPECT_EQ(monitor.counters().poses_unmatched, 1U);
  monitor.receive(facing(-2.5, 1010), kStart + 10ms);
  monitor.receive({1020, {1.0, 2.0, -3.0}, Vec3::Zero()}, kStart + 20ms);
  const auto pose = monitor.takePose();
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->stamp, kStart + 20ms);
  EXPECT_EQ(pose->position_NED_m, Vec3(1.0, 2.0, -3.0));
  EXPECT_NEAR(pose->heading_rad, -2.5, 1e-12);
  EXPECT_FALSE(monitor.takePose());
  monitor.receive({1061, {1.0, 2.0, -3.0}, Vec3::Zero()}, kStart + 61ms);  // the attitude is too old for it
  EXPECT_FALSE(monitor.takePose());
  EXPECT_EQ(monitor.state(kStart + 100ms).position_age, 39ms);
  EXPECT_EQ(monitor.state(kStart + 100ms).attitude_age, 90ms);
}

TEST(AutopilotMonitor, BringsTheAttitudeToThePositionsMoment) {
  AutopilotMonitor monitor = nanomap::monitor();
  AttitudeMessage attitude = facing(0.5, 1000);
  attitude.angular_rate_FRD_rad_s = attitude.R_NED_FRD.conjugate() * Vec3(0.0, 0.0, 1.5);  // about the vertical
  monitor.receive(attitude, kStart);
  monitor.receive({1020, Vec3::Zero(), {4.0, -3.0, 1.0}}, kStart + 20ms);
  const auto pose = monitor.takePose();
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->heading_rad, 0.5 + 1.5 * 0.02, 1e-12);
  EXPECT_TRUE(pose->R_NED_FRD.isApprox(facing(0.53, 0).R_NED_FRD, 1e-12));
  EXPECT_EQ(pose->angular_rate_FRD_rad_s, attitude.angular_rate_FRD_rad_s);
  EXPECT_EQ(pose->velocity_NED_m_s, Vec3(4.0, -3.0, 1.0));
}

TEST(AutopilotMonitor, DropsTheOldestPosesThatNobodyTakes) {
  AutopilotMonitor monitor = nanomap::monitor();
  for (std::uint32_t i = 0; i < 100; ++i) {
    monitor.receive(facing(0.0, i * 20), kStart + i * 20ms);
    monitor.receive({i * 20, {static_cast<double>(i), 0.0, 0.0}, Vec3::Zero()}, kStart + i * 20ms);
  }
  EXPECT_EQ(monitor.counters().poses, 100U);
  EXPECT_EQ(monitor.counters().poses_dropped, 36U);
  EXPECT_EQ(monitor.takePose()->position_NED_m.x(), 36.0);
}

TEST(AutopilotMonitor, TellsWhetherItHasLanded) {
  AutopilotMonitor monitor = nanomap::monitor();
  EXPECT_EQ(monitor.state(kStart).landed, LandedState::kUnknown);
  monitor.receive(LandedStateMessage{1}, kStart);
  EXPECT_EQ(monitor.state(kStart).landed, LandedState::kOnGround);
  monitor.receive(LandedStateMessage{2}, kStart);
  EXPECT_EQ(monitor.state(kStart).landed, LandedState::kInAir);
  monitor.receive(LandedStateMessage{77}, kStart);
  EXPECT_EQ(monitor.state(kStart).landed, LandedState::kUnknown);
}

}  // namespace
}  // namespace nanomap
