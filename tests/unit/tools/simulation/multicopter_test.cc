#include "tools/simulation/multicopter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/level_frame.h"
#include "tools/simulation/attitude.h"
#include "tools/simulation/position_controller.h"

namespace nanomap::simulation {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(10);

Multicopter hovering() { return Multicopter({}, {0.0, 0.0, 2.0}, 0.5); }

TEST(Multicopter, ToldNothingItHovers) {
  Multicopter vehicle = hovering();
  vehicle.advance({Vec3::Zero(), 0.5}, std::chrono::seconds(5));
  const VehicleState state = vehicle.state();
  EXPECT_LT((state.T_W_B.translation_m - Vec3(0.0, 0.0, 2.0)).norm(), 1e-9);
  EXPECT_LT(state.velocity_W_m_s.norm(), 1e-9);
  EXPECT_NEAR(yawOf(state.T_W_B.rotation), 0.5, 1e-9);
}

/// The thrust's direction follows with the attitude's lag, so that the velocity falls behind by acceleration * lag.
TEST(Multicopter, FallsBehindByItsLagAndByDrag) {
  MulticopterParameters parameters;
  parameters.drag_1_s = 1e-9;
  Multicopter vehicle(parameters, Vec3::Zero(), 0.0);
  constexpr double kAcceleration_m_s2 = 2.0;
  vehicle.advance({Vec3(kAcceleration_m_s2, 0.0, 0.0), 0.0}, std::chrono::seconds(1));
  const double behind_m_s = kAcceleration_m_s2 - vehicle.state().velocity_W_m_s.x();
  EXPECT_NEAR(behind_m_s, kAcceleration_m_s2 * parameters.attitude_time_constant_s, 0.02);

  Multicopter dragged({}, Vec3::Zero(), 0.0);
  dragged.advance({Vec3(1.0, 0.0, 0.0), 0.0}, std::chrono::seconds(100));
  EXPECT_NEAR(dragged.state().velocity_W_m_s.x(), 1.0 / MulticopterParameters{}.drag_1_s, 0.01) << "terminal velocity";
}

TEST(Multicopter, TiltsNoFartherThanItMayAndKeepsItsHeight) {
  Multicopter vehicle = hovering();
  vehicle.advance({Vec3(0.0, 50.0, 0.0), 0.5}, std::chrono::seconds(1));
  const VehicleState state = vehicle.state();
  const double tilt_rad = std::acos((state.T_W_B.rotation * Vec3::UnitZ()).z());
  EXPECT_NEAR(tilt_rad, MulticopterParameters{}.max_tilt_rad, 1e-3);
  EXPECT_NEAR(state.T_W_B.translation_m.z(), 2.0, 0.3);
}

TEST(Multicopter, TurnsTheShorterWayAtItsLimitedRate) {
  Multicopter vehicle({}, Vec3::Zero(), 3.0);
  vehicle.advance({Vec3::Zero(), -3.0}, std::chrono::milliseconds(100));
  EXPECT_GT(wrapAngle(yawOf(vehicle.state().T_W_B.rotation) - 3.0), 0.0) << "across pi";
  EXPECT_LE(vehicle.state().angular_rate_B_rad_s.norm(), MulticopterParameters{}.max_yaw_rate_rad_s + 1e-6);
  vehicle.advance({Vec3::Zero(), -3.0}, std::chrono::seconds(3));
  EXPECT_NEAR(wrapAngle(yawOf(vehicle.state().T_W_B.rotation) + 3.0), 0.0, 1e-3);
}

TEST(Multicopter, ImpossibleParametersAreNamed) {
  MulticopterParameters weak;
  weak.max_thrust_m_s2 = 9.0;
  EXPECT_THAT([&] { Multicopter(weak, Vec3::Zero(), 0.0); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("max_thrust_m_s2")));
}

/// Against drag, which nobody told it of.
TEST(PositionController, HoldsASetpointThatMoves) {
  Multicopter vehicle({}, Vec3::Zero(), 0.0);
  PositionController controller({});
  const Vec3 velocity_W_m_s(3.0, -1.0, 0.5);
  Vec3 setpoint_W_m = Vec3::Zero();
  double error_m = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const VehicleState state = vehicle.state();
    const Motion estimated{state.T_W_B.translation_m, state.velocity_W_m_s, Vec3::Zero()};
    error_m = (estimated.position_m - setpoint_W_m).norm();
    const Vec3 acceleration = controller.acceleration({setpoint_W_m, velocity_W_m_s, Vec3::Zero()}, estimated, kPeriod);
    vehicle.advance({acceleration, 0.0}, kPeriod);
    setpoint_W_m += velocity_W_m_s * toSeconds(kPeriod);
  }
  EXPECT_LT(error_m, 0.02);
}

TEST(Attitude, ThrustCarriesTheAccelerationAndTheNosePointsAlongTheYaw) {
  const Vec3 acceleration_W(3.0, -2.0, 1.0);
  const Quat R_W_B = attitudeFor(acceleration_W, 0.7);
  const Vec3 thrust_W = acceleration_W + kGravity_m_s2 * Vec3::UnitZ();
  EXPECT_LT((R_W_B * Vec3::UnitZ() - thrust_W.normalized()).norm(), 1e-12);
  EXPECT_NEAR(yawOf(R_W_B), 0.7, 1e-12);
}

}  // namespace
}  // namespace nanomap::simulation
