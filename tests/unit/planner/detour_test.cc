#include "planner/detour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::goalAt;

constexpr Duration kPeriod = 50ms;

/// A vehicle at W's origin that looks along x, where its goal is; what becomes of its plans is what a test says.
class DetourTest : public testing::Test {
 protected:
  /// The angle that the goal is turned by, left positive.
  double step(Reason reason) {
    const Goal steered = detour_.steer(state_, goal_);
    detour_.note(reason);
    state_.stamp += kPeriod;
    const Vec3 to_goal_W = goal_.position_W_m - state_.T_W_B.translation_m;
    const Vec3 to_steered_W = steered.position_W_m - state_.T_W_B.translation_m;
    return std::remainder(std::atan2(to_steered_W.y(), to_steered_W.x()) - std::atan2(to_goal_W.y(), to_goal_W.x()),
                          2.0 * std::numbers::pi);
  }

  double run(Duration duration, Reason reason) {
    double turned_rad = 0.0;
    for (const Time end = state_.stamp + duration; state_.stamp < end;) turned_rad = step(reason);
    return turned_rad;
  }

  void look(double yaw_rad) { state_.T_W_B.rotation = Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ())); }
  void moveTo(const Vec3& position_W_m) { state_.T_W_B.translation_m = position_W_m; }

  DetourParameters parameters_;
  Detour detour_{parameters_};
  VehicleState state_{.stamp = Time(1999ms), .T_W_B = {Quat::Identity(), Vec3::Zero()}};
  Goal goal_ = goalAt({50.0, 0.0, 2.0});
};

TEST_F(DetourTest, PatienceComesFirst) {
  EXPECT_EQ(run(parameters_.patience, Reason::kBlocked), 0.0);
  EXPECT_FALSE(detour_.isTurned());
  EXPECT_NEAR(run(1s, Reason::kBlocked), parameters_.turn_rate_rad_s, 0.15);
  EXPECT_TRUE(detour_.isTurned());
}

TEST_F(DetourTest, TurnsToTheSideThatTheVehicleLooksTo) {
  look(-0.3);
  EXPECT_LT(run(3s, Reason::kBlocked), -0.5);
}

TEST_F(DetourTest, TheGoalIsTurnedAboutTheVehicleAtItsHeight) {
  (void)run(4s, Reason::kBlocked);
  const Goal steered = detour_.steer(state_, goal_);
  EXPECT_NEAR(steered.position_W_m.head<2>().norm(), 50.0, 1e-9);
  EXPECT_EQ(steered.position_W_m.z(), goal_.position_W_m.z());
  EXPECT_EQ(steered.sequence, goal_.sequence);
}

/// Else it is carried past its goal, and circles it.
TEST_F(DetourTest, NearItsGoalItFliesNoFasterThanItCanTurn) {
  goal_ = goalAt({50.0, 0.0, 2.0}, 9.0);
  const auto topSpeedAt = [&](double distance_m) {
    moveTo({50.0 - distance_m, 0.0, 2.0});
    return detour_.steer(state_, goal_).top_speed_m_s;
  };
  const auto beginAt = [&](double distance_m) {
    detour_ = Detour(parameters_);
    EXPECT_EQ(topSpeedAt(distance_m), 9.0) << "it is not on its way round yet";
    (void)run(4s, Reason::kBlocked);
    EXPECT_TRUE(detour_.isTurned());
  };
  beginAt(50.0);
  EXPECT_EQ(topSpeedAt(50.0), 9.0);
  beginAt(10.0);
  EXPECT_NEAR(topSpeedAt(10.0), 0.5 * parameters_.turn_rate_rad_s * 10.0, 1e-9);
  EXPECT_NEAR(topSpeedAt(8.0), 0.5 * parameters_.turn_rate_rad_s * 8.0, 1e-9);
  beginAt(4.0);
  EXPECT_EQ(topSpeedAt(1.5), 1.0) << "it need not creep";
  goal_.top_speed_m_s = 0.8;
  EXPECT_EQ(topSpeedAt(1.5), 0.8);
}

TEST_F(DetourTest, WhoMakesProgressIsLeftAlone) {
  for (int i = 0; i < 200; ++i) {
    moveTo({0.02 * i, 0.0, 0.0});
    EXPECT_EQ(step(Reason::kFlying), 0.0);
    EXPECT_EQ(step(Reason::kKeeping), 0.0);
  }
}

TEST_F(DetourTest, WhoDoesNotWantToGoOnIsLeftAlone) {
  for (const Reason reason : {Reason::kAtGoal, Reason::kTurning, Reason::kSlowing, Reason::kNoView}) {
    EXPECT_EQ(run(10s, reason), 0.0) << toString(reason);
  }
}

TEST_F(DetourTest, HeldUpJustBeforeItsGoalItStays) {
  goal_ = goalAt({2.9, 0.0, 0.0});
  EXPECT_EQ(run(30s, Reason::kBlocked), 0.0);
  parameters_.near_goal_m = 2.8;
  detour_ = Detour(parameters_);
  EXPECT_NE(run(4s, Reason::kBlocked), 0.0);
}

TEST_F(DetourTest, CreepingIsNoProgress) {
  for (int i = 0; i < 100; ++i) {
    moveTo({0.001 * i, 0.0, 0.0});
    (void)step(i % 3 == 0 ? Reason::kBlocked : Reason::kFlying);
  }
  EXPECT_TRUE(detour_.isTurned());
}

/// It waits for something that is too near to be behind it: neither patience nor the turn is about that.
TEST_F(DetourTest, ARetreatTakesNoTime) {
  (void)run(parameters_.patience - 500ms, Reason::kBlocked);
  EXPECT_EQ(run(10s, Reason::kRetreating), 0.0);
  EXPECT_EQ(run(400ms, Reason::kBlocked), 0.0) << "patience goes on where it was";
  const double turned_rad = run(2s, Reason::kBlocked);
  EXPECT_GT(turned_rad, 1.0);
  EXPECT_NEAR(run(3s, Reason::kRetreating), turned_rad, parameters_.turn_rate_rad_s * toSeconds(kPeriod) + 1e-9);
}

TEST_F(DetourTest, TheCourseLeansBackFromTheMotion) {
  (void)run(5s, Reason::kBlocked);
  state_.velocity_W_m_s = {0.0, 3.0, 0.0};  // along a wall across the way
  EXPECT_NEAR(run(4s, Reason::kFlying), std::numbers::pi / 2.0 - parameters_.lean_rad, 0.05);
}

TEST_F(DetourTest, EndsTowardsTheGoalAndNearerToItThanItBegan) {
  (void)run(5s, Reason::kBlocked);
  state_.velocity_W_m_s = {3.0, 0.0, 0.0};
  EXPECT_EQ(run(5s, Reason::kFlying), 0.0);
  (void)run(2s, Reason::kBlocked);
  state_.velocity_W_m_s.setZero();
  EXPECT_GT(run(1s, Reason::kBlocked), 0.5) << "not nearer: it goes on at once, to the same side";
  state_.velocity_W_m_s = {3.0, 0.0, 0.0};
  (void)run(5s, Reason::kFlying);
  moveTo({1.0, 0.0, 0.0});
  (void)step(Reason::kFlying);
  state_.velocity_W_m_s.setZero();
  EXPECT_EQ(run(parameters_.patience, Reason::kBlocked), 0.0) << "it is over: patience again";
}

/// Past a goal nearby, the direction to it turns as fast as the course can lean back.
TEST_F(DetourTest, IsOverAGoodDealNearerWhereverItsCoursePoints) {
  EXPECT_GT(run(5s, Reason::kBlocked), 1.0);
  state_.velocity_W_m_s = {0.0, 3.0, 0.0};
  moveTo({2.5, 0.0, 0.0});
  EXPECT_GT(step(Reason::kFlying), 0.5) << "it may have to come back";
  moveTo({3.2, 0.0, 0.0});
  EXPECT_EQ(step(Reason::kFlying), 0.0);
  EXPECT_FALSE(detour_.isTurned());
}

TEST_F(DetourTest, ATurnWithoutEndIsTriedToTheOtherSideAndGivenUp) {
  const double full_turn_s = 2.0 * std::numbers::pi / parameters_.turn_rate_rad_s;
  (void)run(parameters_.patience + fromSeconds(full_turn_s) + 1s, Reason::kBlocked);
  EXPECT_LT(run(1s, Reason::kBlocked), -0.5);
  (void)run(fromSeconds(full_turn_s), Reason::kBlocked);
  EXPECT_EQ(run(60s, Reason::kBlocked), 0.0);
}

TEST_F(DetourTest, AWayThatLeadsBackIsTriedToTheOtherSide) {
  EXPECT_GT(run(4s, Reason::kBlocked), 0.5);
  moveTo({0.0, 7.0, 0.0});
  (void)run(500ms, Reason::kBlocked);
  moveTo({0.0, 2.0, 0.0});
  EXPECT_LT(run(1s, Reason::kBlocked), -0.5);
}

TEST_F(DetourTest, WhatIsBackIsAsFarAsConfigured) {
  parameters_.return_m = 1.0;
  detour_ = Detour(parameters_);
  (void)run(3s, Reason::kBlocked);
  moveTo({0.0, 2.1, 0.0});
  (void)run(500ms, Reason::kBlocked);
  moveTo({0.0, 1.1, 0.0});
  EXPECT_GT(run(500ms, Reason::kBlocked), 0.5);
  moveTo({0.0, 0.9, 0.0});
  EXPECT_LT(run(1s, Reason::kBlocked), -0.5);
}

TEST_F(DetourTest, AnAttemptThatTakesTooLongIsTriedToTheOtherSide) {
  EXPECT_GT(run(4s, Reason::kBlocked), 0.5);
  state_.velocity_W_m_s = {0.0, 3.0, 0.0};
  EXPECT_GT(run(parameters_.give_up_after - 3s, Reason::kFlying), 0.5);
  (void)run(2s, Reason::kFlying);
  state_.velocity_W_m_s.setZero();
  EXPECT_LT(run(1s, Reason::kBlocked), -0.5);
}

TEST_F(DetourTest, ANewGoalStartsAnewAndAShiftedOneDoesNot) {
  (void)run(4s, Reason::kBlocked);
  goal_.position_W_m.x() += 0.9;
  ++goal_.sequence;
  EXPECT_GT(step(Reason::kBlocked), 0.5);
  goal_.position_W_m.x() += 1.1;
  EXPECT_EQ(step(Reason::kBlocked), 0.0);
  EXPECT_FALSE(detour_.isTurned());
}

TEST_F(DetourTest, AGoalOfAnotherWorldStartsAnew) {
  (void)run(4s, Reason::kBlocked);
  ++goal_.epoch;
  ++state_.epoch;
  EXPECT_EQ(step(Reason::kBlocked), 0.0);
}

TEST_F(DetourTest, TimeThatGoesBackwardsTurnsNothing) {
  const double turned_rad = run(4s, Reason::kBlocked);
  state_.stamp -= 1s;
  EXPECT_NEAR(step(Reason::kBlocked), turned_rad, 1e-9);
}

TEST_F(DetourTest, WithoutTimeToGiveUpAfterThereIsNone) {
  parameters_.give_up_after = Duration::zero();
  detour_ = Detour(parameters_);
  EXPECT_EQ(run(30s, Reason::kBlocked), 0.0);
}

}  // namespace
}  // namespace nanomap
