#include "firmware_app/safety/feedforward.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/firmware_app/safety/healthy.h"
#include "tools/simulation/multicopter.h"
#include "tools/simulation/position_controller.h"

namespace nanomap {
namespace {

constexpr Feedforward kNone{.setpoint_lead = Duration::zero(), .tilt_lag = Duration::zero(), .drag_1_s = 0.0};

/// From rest to 6 m/s, 2 s on at that, and a hard brake.
Trajectory dash() {
  Trajectory dash_W(atMs(1000), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  const auto change = [&dash_W](double jerk_m_s3, double ramp_s, double hold_s) {
    dash_W.append(ramp_s, {jerk_m_s3, 0.0, 0.0});
    dash_W.append(hold_s, Vec3::Zero());
    dash_W.append(ramp_s, {-jerk_m_s3, 0.0, 0.0});
  };
  change(20.0, 0.2, 1.3);
  dash_W.append(2.0, Vec3::Zero());
  change(-30.0, 0.2, 0.8);
  return dash_W;
}

/// How far a simulated vehicle gets from the motion that it is told, at the most.
double farthestOff_m(const Feedforward& feedforward, const Trajectory& motion_W = dash()) {
  constexpr Duration kPeriod = std::chrono::milliseconds(10);
  simulation::Multicopter vehicle({}, Vec3::Zero(), 0.0);
  simulation::PositionController controller({});
  double farthest_m = 0.0;
  for (Time now = motion_W.start(); now < motion_W.start() + std::chrono::seconds(6); now += kPeriod) {
    const simulation::VehicleState state = vehicle.state();
    const Motion own_W{state.T_W_B.translation_m, state.velocity_W_m_s, state.acceleration_W_m_s2};
    farthest_m = std::max(farthest_m, (own_W.position_m - motion_W.sample(now).position_m).norm());
    const Vec3 command_W = controller.acceleration(feedforward.sample(motion_W, now), own_W, kPeriod);
    vehicle.advance({command_W, 0.0}, kPeriod);
  }
  return farthest_m;
}

TEST(Feedforward, EachPartIsToldForItsOwnMoment) {
  const Trajectory motion_W = dash();
  const Time now = motion_W.start() + std::chrono::milliseconds(50);
  const Motion told_W =
      Feedforward{
          .setpoint_lead = std::chrono::milliseconds(30), .tilt_lag = std::chrono::milliseconds(70), .drag_1_s = 0.25}
          .sample(motion_W, now);
  const Motion acted_on_W = motion_W.sample(now + std::chrono::milliseconds(30));
  EXPECT_EQ(told_W.position_m, acted_on_W.position_m);
  EXPECT_EQ(told_W.velocity_m_s, acted_on_W.velocity_m_s);
  // A ramp of 20 m/s^3 for 0.15 s, and a velocity of 20 * 0.08^2 / 2 m/s.
  EXPECT_NEAR(told_W.acceleration_m_s2.x(), 3.0 + 0.25 * 0.064, 1e-9);
}

TEST(Feedforward, VehicleThatStandsAtTheEndIsToldNoAcceleration) {
  const Trajectory motion_W = dash();
  const Motion told_W = Feedforward{}.sample(motion_W, motion_W.start() + std::chrono::seconds(60));
  EXPECT_NEAR(told_W.velocity_m_s.norm(), 0.0, 1e-9);
  EXPECT_NEAR(told_W.acceleration_m_s2.norm(), 0.0, 1e-9);
}

TEST(Feedforward, VehicleStaysNearerToItsMotion) {
  const double without_m = farthestOff_m(kNone);
  const Feedforward both{.setpoint_lead = Duration::zero()};
  EXPECT_GT(without_m, 0.2);
  EXPECT_LT(farthestOff_m(both), 0.25 * without_m);

  // Each has its part: in a brake the two that are missing oppose each other.
  Feedforward tilt_alone = both;
  tilt_alone.drag_1_s = 0.0;
  EXPECT_LT(farthestOff_m(both), 0.5 * farthestOff_m(tilt_alone));
  Feedforward drag_alone = both;
  drag_alone.tilt_lag = Duration::zero();
  EXPECT_LT(farthestOff_m(both), 0.5 * farthestOff_m(drag_alone));
}

TEST(Feedforward, VehicleWithOtherValuesIsNoWorseOffThanWithoutAny) {
  const double without_m = farthestOff_m(kNone);
  for (const double share : {0.5, 1.5}) {
    const Feedforward other{.setpoint_lead = Duration::zero(),
                            .tilt_lag = fromSeconds(share * toSeconds(Feedforward{}.tilt_lag)),
                            .drag_1_s = share * Feedforward{}.drag_1_s};
    EXPECT_LT(farthestOff_m(other), without_m) << share;
  }
}

TEST(Feedforward, RatherTooLittleDragThanTooMuch) {
  const auto withDrag_m = [](double share) {
    return farthestOff_m({.setpoint_lead = Duration::zero(), .drag_1_s = share * Feedforward{}.drag_1_s});
  };
  EXPECT_LT(withDrag_m(0.5), farthestOff_m(kNone));
  EXPECT_GT(withDrag_m(3.0), 1.5 * farthestOff_m(kNone));
}

/// No tilt comes first there, and the acceleration is told by the same lag: hardly worse than without.
TEST(Feedforward, VehicleThatRisesIsNotFarOff) {
  Trajectory rise_W(atMs(1000), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  for (const double jerk_m_s3 : {10.0, -10.0}) {
    rise_W.append(0.2, {0.0, 0.0, jerk_m_s3});
    rise_W.append(0.8, Vec3::Zero());
    rise_W.append(0.2, {0.0, 0.0, -jerk_m_s3});
  }
  EXPECT_LT(farthestOff_m({.setpoint_lead = Duration::zero()}, rise_W), 0.03);
}

}  // namespace
}  // namespace nanomap
