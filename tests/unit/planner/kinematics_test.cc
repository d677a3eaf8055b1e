#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <set>

#include "core/level_frame.h"
#include "planner/brake.h"
#include "planner/candidates.h"

namespace nanomap {
namespace {

constexpr unsigned kSeed = 11;
constexpr double kRounding = 1e-9;

/// The candidates of random motions that are within the limits, in random directions.
class Kinematics : public testing::Test {
 protected:
  static constexpr int kTrials = 200;

  [[nodiscard]] double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] Vec3 anyVector(double horizontal, double vertical) {
    const double angle_rad = between(-std::numbers::pi, std::numbers::pi);
    const double length = between(0.0, horizontal);
    return {length * std::cos(angle_rad), length * std::sin(angle_rad), between(-vertical, vertical)};
  }

  void draw() {
    start_W_.position_m = anyVector(100.0, 20.0);
    start_W_.velocity_m_s = anyVector(15.0, 3.0);
    start_W_.acceleration_m_s2 =
        anyVector(parameters_.limits.horizontal_at_full_m_s2, parameters_.limits.vertical_m_s2);
    yaw_W_rad_ = between(-std::numbers::pi, std::numbers::pi);
    goal_.position_W_m = anyVector(200.0, 20.0);
    goal_.top_speed_m_s = between(0.5, 15.0);
    candidates_.emplace(parameters_, library_, snapshot_, goal_, Time(std::chrono::seconds(5)), start_W_, yaw_W_rad_);
  }

  /// Calls `visit(index)` for each candidate of each trial.
  template <class Visitor>
  void forEachCandidate(Visitor&& visit) {
    for (int trial = 0; trial < kTrials; ++trial) {
      draw();
      for (std::uint32_t index = 0; index < kCandidateCount; ++index) {
        SCOPED_TRACE(testing::Message() << "trial " << trial << " candidate " << index);
        visit(index);
        if (HasFatalFailure()) return;
      }
    }
  }

  std::mt19937 random_{kSeed};
  PlannerParameters parameters_;
  PrimitiveLibrary library_;
  ChainSnapshot snapshot_;
  Motion start_W_;
  double yaw_W_rad_ = 0.0;
  Goal goal_;
  std::optional<Candidates> candidates_;
};

TEST_F(Kinematics, EveryTrajectoryStartsWithTheVehiclesMotion) {
  forEachCandidate([&](std::uint32_t index) {
    for (const Trajectory& trajectory : {candidates_->motion(index), candidates_->brake(index)}) {
      const Motion start = trajectory.sample(0.0);
      ASSERT_EQ(start.position_m, start_W_.position_m);
      ASSERT_EQ(start.velocity_m_s, start_W_.velocity_m_s);
      ASSERT_EQ(start.acceleration_m_s2, start_W_.acceleration_m_s2);
    }
  });
}

TEST_F(Kinematics, EveryPrimitiveIsPushedAndThenGoesStraightOnToTheHorizon) {
  forEachCandidate([&](std::uint32_t index) {
    if (index == kBrake) return;
    const Trajectory motion = candidates_->motion(index);
    const Vec3 wanted_W = levelAxes(yaw_W_rad_) * candidates_->acceleration_L(index);
    const PrimitiveTimes times = parameters_.horizon.at(start_W_.velocity_m_s.norm());
    const double in_s = parameters_.limits.rampFor_s((wanted_W - start_W_.acceleration_m_s2).norm());
    const double out_s = parameters_.limits.rampFor_s(wanted_W.norm());
    const double pushed_s = std::max(times.push_s, in_s);
    ASSERT_NEAR(motion.duration_s(), times.horizon_s, kRounding);
    for (const double elapsed_s : {in_s, 0.5 * (in_s + pushed_s), pushed_s}) {
      ASSERT_LT((motion.sample(elapsed_s).acceleration_m_s2 - wanted_W).norm(), kRounding);
    }
    ASSERT_LT(pushed_s + out_s, times.horizon_s);
    for (const double elapsed_s : {pushed_s + out_s, motion.duration_s()}) {
      ASSERT_LT(motion.sample(elapsed_s).acceleration_m_s2.norm(), kRounding);
    }
    // In closed form: a linear ramp of the acceleration, half of a t^2, and a ramp again; then the velocity is kept.
    const double held_s = pushed_s - in_s;
    const double straight_s = times.horizon_s - pushed_s - out_s;
    const Vec3 v_in_W = start_W_.velocity_m_s + 0.5 * in_s * (start_W_.acceleration_m_s2 + wanted_W);
    const Vec3 v_held_W = v_in_W + held_s * wanted_W;
    const Vec3 v_end_W = v_held_W + 0.5 * out_s * wanted_W;
    const Vec3 p_in_W = start_W_.position_m + in_s * start_W_.velocity_m_s +
                        in_s * in_s * (start_W_.acceleration_m_s2 / 3.0 + wanted_W / 6.0);
    const Vec3 p_held_W = p_in_W + held_s * v_in_W + 0.5 * held_s * held_s * wanted_W;
    const Vec3 p_out_W = p_held_W + out_s * v_held_W + out_s * out_s * wanted_W / 3.0;
    ASSERT_LT((motion.atEnd().velocity_m_s - v_end_W).norm(), 1e-8);
    ASSERT_LT((motion.atEnd().position_m - (p_out_W + straight_s * v_end_W)).norm(), 1e-8);
  });
}

TEST_F(Kinematics, HorizonCutsAPrimitiveThatIsStillPushed) {
  draw();
  const Vec3 pushed_m_s2(2.0, -1.0, 0.5);
  const Trajectory whole = primitive({}, start_W_, pushed_m_s2, {.push_s = 0.6, .horizon_s = 3.0}, parameters_.limits);
  for (const double horizon_s : {0.1, 0.5, 0.7, 2.0}) {
    const Trajectory cut =
        primitive({}, start_W_, pushed_m_s2, {.push_s = 0.6, .horizon_s = horizon_s}, parameters_.limits);
    EXPECT_NEAR(cut.duration_s(), horizon_s, kRounding);
    EXPECT_LT((cut.atEnd().position_m - whole.sample(horizon_s).position_m).norm(), kRounding);
  }
}

TEST_F(Kinematics, EveryTrajectoryAgreesWithNumericIntegration) {
  constexpr double kStep_s = 1e-3;
  for (int trial = 0; trial < 5; ++trial) {
    draw();
    for (std::uint32_t index = 0; index < kCandidateCount; ++index) {
      for (const Trajectory& trajectory : {candidates_->motion(index), candidates_->brake(index)}) {
        Vec3 velocity = start_W_.velocity_m_s;
        Vec3 position = start_W_.position_m;
        const double duration_s = trajectory.duration_s();
        for (double t_s = 0.0; t_s < duration_s; t_s += kStep_s) {
          const double step_s = std::min(kStep_s, duration_s - t_s);
          const Vec3 acceleration = trajectory.sample(t_s + step_s / 2.0).acceleration_m_s2;
          position += step_s * (velocity + step_s / 2.0 * acceleration);
          velocity += step_s * acceleration;
        }
        // Where a step spans two pieces the midpoint rule errs by up to jerk * step^2.
        ASSERT_LT((trajectory.atEnd().velocity_m_s - velocity).norm(), 1e-3);
        ASSERT_LT((trajectory.atEnd().position_m - position).norm(), 1e-2);
      }
    }
  }
}

TEST_F(Kinematics, AccelerationAndJerkStayWithinTheirLimits) {
  const MotionLimits& limits = parameters_.limits;
  forEachCandidate([&](std::uint32_t index) {
    const double primitive_limit_m_s2 =
        std::max(limits.horizontal_m_s2(start_W_.velocity_m_s.norm()), start_W_.acceleration_m_s2.head<2>().norm());
    const double motion_limit_m_s2 = index == kBrake ? limits.horizontal_at_full_m_s2 : primitive_limit_m_s2;
    const auto expectWithin = [&](const Trajectory& trajectory, double horizontal_limit_m_s2) {
      for (const Trajectory::Piece& piece : trajectory.pieces()) {
        ASSERT_LE(piece.jerk_W_m_s3.norm(), limits.jerk_m_s3 + kRounding);
      }
      for (double t_s = 0.0; t_s < trajectory.duration_s(); t_s += 0.01) {
        const Vec3 acceleration = trajectory.sample(t_s).acceleration_m_s2;
        ASSERT_LE(acceleration.head<2>().norm(), horizontal_limit_m_s2 + kRounding);
        ASSERT_LE(std::abs(acceleration.z()), limits.vertical_m_s2 + kRounding);
      }
    };
    expectWithin(candidates_->motion(index), motion_limit_m_s2);
    expectWithin(candidates_->brake(index), limits.horizontal_at_full_m_s2);
  });
}

TEST_F(Kinematics, EveryBrakeFollowsItsPrimitiveAndThenEndsAtRest) {
  forEachCandidate([&](std::uint32_t index) {
    const Trajectory motion = candidates_->motion(index);
    const Trajectory brake = candidates_->brake(index);
    for (const double elapsed_s : {0.05, 0.15, parameters_.brake_after_s}) {
      ASSERT_LT((motion.sample(elapsed_s).position_m - brake.sample(elapsed_s).position_m).norm(), kRounding);
    }
    ASSERT_LT(brake.atEnd().velocity_m_s.norm(), kRounding);
    ASSERT_LT(brake.atEnd().acceleration_m_s2.norm(), kRounding);
    ASSERT_LT((brake.sample(1e3).position_m - brake.atEnd().position_m).norm(), kRounding);
  });
}

/// Once braking at the limit, braking again does not end farther on: what was verified stays within reach.
TEST_F(Kinematics, BrakingAgainOnTheWayStopsAtTheSamePlace) {
  Motion start;
  start.velocity_m_s = {8.0, 0.0, 0.0};
  const Trajectory brake = brakeAfter(Trajectory(Time{}, start), 0.0, parameters_.limits);
  for (double t_s = 0.2; t_s < brake.duration_s(); t_s += 0.05) {
    const Trajectory again = brakeAfter(Trajectory(Time{}, brake.sample(t_s)), 0.0, parameters_.limits);
    EXPECT_LT(again.atEnd().position_m.x(), brake.atEnd().position_m.x() + 0.05) << t_s;
  }
}

TEST(PrimitiveLibrary, HoldsEveryDirectionOnceWithinTheLimits) {
  const PrimitiveLibrary library;
  const MotionLimits limits;
  std::set<std::tuple<double, double, double>> distinct;
  for (std::uint32_t index = 0; index < kLibrarySize; ++index) {
    const Vec3 acceleration = library.acceleration_L(index, limits, 10.0);
    EXPECT_LE(acceleration.head<2>().norm(), 7.5 + kRounding);
    EXPECT_LE(std::abs(acceleration.z()), limits.vertical_m_s2);
    const auto rounded = [](double value) { return std::round(value * 1e6); };
    distinct.emplace(rounded(acceleration.x()), rounded(acceleration.y()), rounded(acceleration.z()));
  }
  EXPECT_EQ(distinct.size(), kLibrarySize);
}

TEST(PrimitiveLibrary, HorizontalLimitGrowsWithSpeedUpToItsFullValue) {
  const MotionLimits limits;
  EXPECT_DOUBLE_EQ(limits.horizontal_m_s2(0.0), 2.5);
  EXPECT_DOUBLE_EQ(limits.horizontal_m_s2(5.0), 5.0);
  EXPECT_DOUBLE_EQ(limits.horizontal_m_s2(10.0), 7.5);
  EXPECT_DOUBLE_EQ(limits.horizontal_m_s2(30.0), 7.5);
}

TEST(Horizon, IsTheTimeToFlyItsDistanceWithinItsLimits) {
  const HorizonParameters horizon;
  EXPECT_DOUBLE_EQ(horizon.at(0.0).horizon_s, 1.5);
  EXPECT_DOUBLE_EQ(horizon.at(2.5).horizon_s, 1.2);
  EXPECT_DOUBLE_EQ(horizon.at(40.0).horizon_s, 1.0);
}

TEST(GoalDirected, LeadsToTheWantedVelocityWithinTheLimits) {
  const GoalDirectedParameters parameters;
  const MotionLimits limits;
  const Vec3 far = goalDirectedAcceleration({30.0, 40.0, 0.0}, Vec3::Zero(), 4.0, parameters, limits);
  EXPECT_NEAR(far.norm(), 2.5, kRounding);
  EXPECT_NEAR(far.y() / far.x(), 4.0 / 3.0, kRounding);
  const Vec3 there = goalDirectedAcceleration(Vec3::Zero(), Vec3::Zero(), 4.0, parameters, limits);
  EXPECT_EQ(there, Vec3::Zero());
  const Vec3 cruising = goalDirectedAcceleration({50.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 4.0, parameters, limits);
  EXPECT_LT(cruising.norm(), kRounding);
}

}  // namespace
}  // namespace nanomap
