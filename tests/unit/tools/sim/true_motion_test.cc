#include "tools/sim/true_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/sim/scene_placement.h"

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart = Time(999'900ms);  // a second boundary lies 100 ms ahead

/// Turns about the vertical and accelerates to the north, climbing.
AutopilotPose vehicleAt(Time stamp) {
  const double t_s = toSeconds(stamp - kStart);
  AutopilotPose pose;
  pose.stamp = stamp;
  pose.position_NED_m = {100.0 + 3.0 * t_s + t_s * t_s, 20.0, -4.0 - 0.5 * t_s};
  pose.velocity_NED_m_s = {3.0 + 2.0 * t_s, 0.0, -0.5};
  pose.heading_rad = 0.7 + 1.2 * t_s;
  pose.R_NED_FRD = Quat(Eigen::AngleAxisd(pose.heading_rad, Vec3::UnitZ()));
  pose.angular_rate_FRD_rad_s = {0.0, 0.0, 1.2};
  return pose;
}

TrueMotion motionUntil(Time last, Duration period) {
  TrueMotion motion{NedFromWorld()};
  for (Time stamp = kStart; stamp <= last; stamp += period) motion.add(vehicleAt(stamp));
  return motion;
}

TEST(TrueMotion, ContinuesTheNewestPose) {
  const TrueMotion motion = motionUntil(kStart + 200ms, 20ms);
  const Time later = kStart + 215ms;
  const simulation::VehicleState state = motion.at(later);
  const AutopilotPose truth = vehicleAt(later);
  EXPECT_NEAR(state.T_W_B.translation_m.x(), truth.position_NED_m.x(), 1e-9);
  EXPECT_NEAR(state.T_W_B.translation_m.y(), -truth.position_NED_m.y(), 1e-9);
  EXPECT_NEAR(state.T_W_B.translation_m.z(), -truth.position_NED_m.z(), 1e-9);
  EXPECT_TRUE(state.velocity_W_m_s.isApprox(flipped(truth.velocity_NED_m_s), 1e-9));
  EXPECT_TRUE(state.acceleration_W_m_s2.isApprox(Vec3(2.0, 0.0, 0.0), 1e-9));
  EXPECT_NEAR(yawOf(state.T_W_B.rotation), -truth.heading_rad, 1e-9);
  EXPECT_TRUE(state.angular_rate_B_rad_s.isApprox(Vec3(0.0, 0.0, -1.2)));
}

TEST(TrueMotion, AMomentOfThePastIsToldByThePoseBeforeIt) {
  const TrueMotion motion = motionUntil(kStart + 300ms, 20ms);
  EXPECT_NEAR(motion.at(kStart + 150ms).T_W_B.translation_m.x(), vehicleAt(kStart + 150ms).position_NED_m.x(), 1e-9);
}

TEST(TrueMotion, SaysHowGoodItIs) {
  TrueMotion motion = motionUntil(kStart + 100ms, 20ms);
  EXPECT_EQ(motion.error().count, 5U);
  EXPECT_LT(motion.error().worst_m, 1e-3) << "no acceleration is known at first";
  AutopilotPose elsewhere = vehicleAt(kStart + 120ms);
  elsewhere.position_NED_m.y() += 0.25;
  elsewhere.R_NED_FRD = elsewhere.R_NED_FRD * Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX()));
  motion.add(elsewhere);
  EXPECT_NEAR(motion.error().worst_m, 0.25, 1e-6);
  EXPECT_NEAR(motion.error().worst_rad, 0.1, 1e-6);
  motion.add(vehicleAt(kStart + 5s));
  EXPECT_EQ(motion.error().count, 6U) << "after a gap nothing was extrapolated";
}

TEST(TrueMotion, PassesOverPosesThatAreNotNewer) {
  TrueMotion motion = motionUntil(kStart + 100ms, 20ms);
  motion.add(vehicleAt(kStart + 100ms));
  AutopilotPose old = vehicleAt(kStart + 40ms);
  old.position_NED_m.setZero();
  motion.add(old);
  EXPECT_EQ(motion.newest(), kStart + 100ms);
  EXPECT_EQ(motion.error().count, 5U);
}

TEST(TrueMotion, TiltIsThatOfTheVehicle) {
  TrueMotion motion{NedFromWorld(0.4, Vec3::Zero())};
  AutopilotPose pose = vehicleAt(kStart);
  // Nose down by 0.3, heading 0.7.
  pose.R_NED_FRD = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(-0.3, Vec3::UnitY()));
  motion.add(pose);
  const Vec3 forward_W = motion.at(kStart).T_W_B.rotation * Vec3::UnitX();
  const double yaw_rad = 0.4 - 0.7;
  EXPECT_TRUE(forward_W.isApprox(
      Vec3(std::cos(0.3) * std::cos(yaw_rad), std::cos(0.3) * std::sin(yaw_rad), -std::sin(0.3)), 1e-9));
  EXPECT_GT((motion.at(kStart).T_W_B.rotation * Vec3::UnitZ()).z(), 0.9) << "it does not fly upside down";
}

TEST(PlaceScene, StartIsAtTheVehicleAndTheGoalInItsDirection) {
  simulation::Mission mission;
  mission.start_W = {2.0, 3.0, 5.0};
  mission.goal_W = {2.0, 13.0, 5.0};  // along W's y
  const AutopilotPose vehicle = vehicleAt(kStart);
  constexpr double kHeading_rad = 0.6;
  const NedFromWorld T_NED_W = placeScene(mission, vehicle, false, kHeading_rad);
  EXPECT_TRUE(T_NED_W.point({2.0, 3.0, 4.0}).isApprox(vehicle.position_NED_m, 1e-9));
  const Vec3 way_NED = T_NED_W.direction(mission.goal_W - mission.start_W);
  EXPECT_NEAR(std::atan2(way_NED.y(), way_NED.x()), kHeading_rad, 1e-9);
  EXPECT_NEAR(T_NED_W.point(Vec3::Zero()).z(), 0.0, 1e-9) << "the ground is where LOCAL_NED begins";
}

TEST(PlaceScene, GroundIsBelowAVehicleThatStands) {
  AutopilotPose vehicle = vehicleAt(kStart);
  vehicle.position_NED_m.z() = -0.35;  // its estimator has drifted
  const NedFromWorld T_NED_W = placeScene(simulation::Mission(), vehicle, true, 0.0);
  EXPECT_NEAR(T_NED_W.pointInWorld(vehicle.position_NED_m).z(), 0.0, 1e-9);
}

}  // namespace
}  // namespace nanomap::sim
