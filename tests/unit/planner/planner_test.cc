#include "planner/planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/level_frame.h"
#include "planner/heading.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using test::Block;
using test::DrawnWorld;
using test::Flight;
using test::goalAt;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Hovers at 2 m over an empty field, having taken a look.
class PlannerAtHover : public testing::Test {
 protected:
  PlannerAtHover() { flight_.look(); }

  [[nodiscard]] Decision plan(const VehicleState& state, const std::optional<Goal>& goal) const {
    return flight_.planner().plan(flight_.snapshot(), state, goal, flight_.now());
  }

  Flight flight_{DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0};
  Goal goal_ = goalAt({50.0, 0.0, 2.0});
};

void expectNothingToFly(const Decision& decision, Reason reason) {
  EXPECT_EQ(decision.reason, reason) << toString(decision.reason);
  EXPECT_FALSE(decision.candidate);
  EXPECT_FALSE(decision.brake_verified);
  EXPECT_TRUE(decision.trajectory.pieces().empty());
  EXPECT_EQ(decision.evaluated, 0U);
}

void expectVerifiedStop(const Decision& decision, Reason reason) {
  EXPECT_EQ(decision.reason, reason) << toString(decision.reason);
  EXPECT_EQ(decision.candidate, kBrake);
  EXPECT_TRUE(decision.brake_verified);
  EXPECT_LT(decision.trajectory.atEnd().velocity_m_s.norm(), 1e-9);
}

TEST_F(PlannerAtHover, FliesAndSaysFromWhat) {
  const Decision decision = plan(flight_.state(), goal_);
  EXPECT_EQ(decision.reason, Reason::kFlying);
  EXPECT_TRUE(decision.brake_verified);
  EXPECT_EQ(decision.stamp, flight_.now());
  EXPECT_EQ(decision.trajectory.start(), flight_.now());
  EXPECT_EQ(decision.consumed.goal_sequence, 7U);
  EXPECT_EQ(decision.consumed.newest_view_sequence, 0U);
  EXPECT_EQ(decision.consumed.view_count, 1U);
  EXPECT_FALSE(decision.consumed.correction_sequence);
  EXPECT_EQ(decision.candidates, kCandidateCount);
  EXPECT_LT(decision.evaluated, decision.candidates);
  EXPECT_GE(decision.feasible, 1U);
}

TEST_F(PlannerAtHover, AStateThatIsNotFiniteOrImplausibleIsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kNaN, infinity, -infinity, 1e300}) {
    VehicleState state = flight_.state();
    state.velocity_W_m_s.y() = bad;
    expectNothingToFly(plan(state, goal_), Reason::kStateInvalid);
    state = flight_.state();
    state.acceleration_W_m_s2.z() = bad;
    expectNothingToFly(plan(state, goal_), Reason::kStateInvalid);
    state = flight_.state();
    state.T_W_B.translation_m.x() = bad;
    expectNothingToFly(plan(state, goal_), Reason::kStateInvalid);
    state = flight_.state();
    state.T_W_B.rotation.w() = bad;
    expectNothingToFly(plan(state, goal_), Reason::kStateInvalid);
  }
}

TEST_F(PlannerAtHover, AStateOfAnotherTimeOrWorldIsRefused) {
  VehicleState state = flight_.state();
  state.stamp = flight_.now() - milliseconds(201);
  expectNothingToFly(plan(state, goal_), Reason::kStateOtherTime);
  state.stamp = flight_.now() + milliseconds(1);
  expectNothingToFly(plan(state, goal_), Reason::kStateOtherTime);
  state.stamp = flight_.now() - milliseconds(200);
  EXPECT_EQ(plan(state, goal_).reason, Reason::kFlying);
  state.epoch = 1;
  expectNothingToFly(plan(state, goal_), Reason::kStateOtherEpoch);
}

TEST_F(PlannerAtHover, AStateIsCarriedOnToTheTimePlannedFor) {
  VehicleState state = flight_.state();
  state.stamp -= milliseconds(100);
  state.velocity_W_m_s = {1.0, 0.0, 0.0};
  state.acceleration_W_m_s2 = {2.0, 0.0, 0.0};
  const Decision decision = plan(state, goal_);
  EXPECT_NEAR(decision.trajectory.atStart().position_m.x(), 0.11, 1e-12);
  EXPECT_NEAR(decision.trajectory.atStart().velocity_m_s.x(), 1.2, 1e-12);
}

TEST_F(PlannerAtHover, WithoutAUsableGoalItStandsStillAndSaysWhy) {
  expectVerifiedStop(plan(flight_.state(), std::nullopt), Reason::kNoGoal);
  Goal goal = goal_;
  goal.position_W_m.z() = kNaN;
  expectVerifiedStop(plan(flight_.state(), goal), Reason::kGoalInvalid);
  goal = goal_;
  goal.top_speed_m_s = 0.0;
  expectVerifiedStop(plan(flight_.state(), goal), Reason::kGoalInvalid);
  goal.top_speed_m_s = kNaN;
  expectVerifiedStop(plan(flight_.state(), goal), Reason::kGoalInvalid);
  goal = goal_;
  goal.position_W_m.x() = 1e300;
  expectVerifiedStop(plan(flight_.state(), goal), Reason::kGoalInvalid);
  goal = goal_;
  goal.epoch = 3;
  expectVerifiedStop(plan(flight_.state(), goal), Reason::kGoalOtherEpoch);
}

TEST_F(PlannerAtHover, WithoutAViewItStandsStill) {
  const Decision decision = flight_.planner().plan(ChainSnapshot{}, VehicleState{}, goal_, Time{});
  expectVerifiedStop(decision, Reason::kNoView);
  EXPECT_FALSE(decision.consumed.newest_view_sequence);
  EXPECT_EQ(decision.yaw_rate_rad_s, 0.0);
}

TEST_F(PlannerAtHover, WithoutAViewAndMovingNothingIsVerified) {
  VehicleState state;
  state.velocity_W_m_s = {5.0, 0.0, 0.0};
  const Decision decision = flight_.planner().plan(ChainSnapshot{}, state, goal_, Time{});
  EXPECT_EQ(decision.reason, Reason::kNothingVerified);
  EXPECT_EQ(decision.candidate, kBrake);
  EXPECT_FALSE(decision.brake_verified);
  EXPECT_FALSE(decision.trajectory.pieces().empty()) << "the attempt is carried, marked as not verified";
  EXPECT_EQ(decision.vetoes.by_status[static_cast<std::size_t>(Status::kEmpty)], 1U);
}

TEST_F(PlannerAtHover, AGoalAtTheVehicleIsReached) {
  expectVerifiedStop(plan(flight_.state(), goalAt({0.0, 0.0, 2.0})), Reason::kAtGoal);
  expectVerifiedStop(plan(flight_.state(), goalAt({0.2, -0.2, 2.1})), Reason::kAtGoal);
}

TEST_F(PlannerAtHover, AGoalBehindIsTurnedToTheShorterWayAtTheLimitedRate) {
  const Decision decision = plan(flight_.state(), goalAt({-20.0, 5.0, 2.0}));
  expectVerifiedStop(decision, Reason::kTurning);
  EXPECT_DOUBLE_EQ(decision.yaw_rate_rad_s, flight_.planner().parameters().heading.max_rate_rad_s);
  EXPECT_LT(plan(flight_.state(), goalAt({-20.0, -5.0, 2.0})).yaw_rate_rad_s, 0.0);
}

TEST_F(PlannerAtHover, ExtremeVelocityIsDecidedAboutInFiniteNumbers) {
  for (const Vec3& velocity_W : {Vec3(99.0, 0.0, 0.0), Vec3(-70.0, 70.0, 70.0), Vec3(0.0, 0.0, -99.0)}) {
    VehicleState state = flight_.state();
    state.velocity_W_m_s = velocity_W;
    const Decision decision = plan(state, goal_);
    EXPECT_EQ(decision.reason, Reason::kNothingVerified);
    EXPECT_EQ(decision.evaluated, kCandidateCount);
    EXPECT_TRUE(decision.brake.atEnd().position_m.allFinite());
    EXPECT_TRUE(std::isfinite(decision.yaw_W_rad));
  }
}

TEST_F(PlannerAtHover, FasterThanTheTopSpeedItSlowsDown) {
  VehicleState state = flight_.state();
  state.velocity_W_m_s = {5.0, 0.0, 0.0};
  expectVerifiedStop(plan(state, goalAt({50.0, 0.0, 2.0}, 1.0)), Reason::kSlowing);
}

TEST_F(PlannerAtHover, TwoCallsGiveTheSameBits) {
  const Decision once = plan(flight_.state(), goal_);
  const Decision again = plan(flight_.state(), goal_);
  EXPECT_EQ(once.candidate, again.candidate);
  EXPECT_EQ(once.risk, again.risk);
  EXPECT_EQ(once.brake_risk, again.brake_risk);
  EXPECT_EQ(once.yaw_W_rad, again.yaw_W_rad);
  EXPECT_EQ(once.vetoes, again.vetoes);
  EXPECT_EQ(once.trajectory.atEnd().position_m, again.trajectory.atEnd().position_m);
  EXPECT_EQ(once.brake.atEnd().position_m, again.brake.atEnd().position_m);
}

/// Braking pitches a vehicle up by 40 degrees: what accelerates level in the library still does in the world.
TEST_F(PlannerAtHover, PrimitivesStayLevelAtFortyDegreesOfPitch) {
  VehicleState state = flight_.state();
  const double yaw_W_rad = 0.7;
  const double pitch_rad = -40.0 * std::numbers::pi / 180.0;
  state.T_W_B.rotation =
      Quat(Eigen::AngleAxisd(yaw_W_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()));
  state.velocity_W_m_s = {1.0, 0.5, 0.0};
  const PlannerParameters& parameters = flight_.planner().parameters();
  const Explanation explanation = flight_.planner().explain(flight_.snapshot(), state, goal_, flight_.now());
  ASSERT_EQ(explanation.candidates.size(), kCandidateCount);
  int level = 0;
  for (const CandidateExplanation& candidate : explanation.candidates) {
    const Vec3 reached_W = candidate.trajectory.sample(parameters.horizon.push_s).acceleration_m_s2;
    if (candidate.proposal.index == kBrake) continue;
    EXPECT_NEAR(reached_W.z(), candidate.acceleration_L_m_s2.z(), 1e-12);
    EXPECT_LT((reached_W - levelAxes(yaw_W_rad) * candidate.acceleration_L_m_s2).norm(), 1e-12);
    if (candidate.acceleration_L_m_s2.z() != 0.0) continue;
    ++level;
    EXPECT_NEAR(candidate.trajectory.atEnd().position_m.z(), 2.0, 1e-12);
    EXPECT_NEAR(candidate.brake.atEnd().position_m.z(), 2.0, 1e-12);
  }
  EXPECT_GE(level, 25);
}

TEST_F(PlannerAtHover, AnExplanationHoldsTheDecisionAndWhatItRestsOn) {
  const Explanation explanation = flight_.planner().explain(flight_.snapshot(), flight_.state(), goal_, flight_.now());
  ASSERT_TRUE(explanation.decision.candidate);
  const CandidateExplanation& chosen = explanation.candidates[*explanation.decision.candidate];
  EXPECT_FALSE(chosen.verdict.veto);
  EXPECT_EQ(chosen.verdict.motion.risk, explanation.decision.risk);
  EXPECT_GE(chosen.evidence.motion.size(), 21U);
  EXPECT_GE(chosen.evidence.brake.size(), 11U);
  for (const CandidateExplanation& candidate : explanation.candidates) {
    double survival = 1.0;
    for (const SampleEvidence& sample : candidate.evidence.motion) survival *= 1.0 - sample.risk;
    EXPECT_EQ(candidate.verdict.motion.risk, 1.0 - survival);
    EXPECT_EQ(candidate.verdict.motion.veto.has_value(), 1.0 - survival > 0.001);
    if (!candidate.verdict.veto) {
      EXPECT_LE(candidate.objective, chosen.objective);
    }
  }
}

/// A wall close ahead of a fast vehicle: nothing is verified, the attempt to brake is marked so.
TEST(Planner, WithEverythingVetoedItSaysSo) {
  Flight flight(DrawnWorld{{Block{{3.0, -40.0, 0.0}, {4.0, 40.0, 20.0}}}}, {0.0, 0.0, 2.0}, 0.0);
  flight.look();
  VehicleState state = flight.state();
  state.velocity_W_m_s = {9.0, 0.0, 0.0};
  const Decision decision = flight.planner().plan(flight.snapshot(), state, goalAt({50.0, 0.0, 2.0}), flight.now());
  EXPECT_EQ(decision.reason, Reason::kNothingVerified);
  EXPECT_FALSE(decision.brake_verified);
  EXPECT_EQ(decision.feasible, 0U);
  std::uint32_t vetoes = decision.vetoes.by_neighbours;
  for (const std::uint32_t of_status : decision.vetoes.by_status) vetoes += of_status;
  EXPECT_EQ(vetoes, kCandidateCount);
  EXPECT_EQ(decision.risk, 1.0);
}

/// What it comes to a stand before must be in view until then; only then does it look around.
TEST(Planner, WhileItBrakesTheCameraLooksWhereItFlies) {
  PlannerParameters parameters = test::flightParameters();
  parameters.heading.reach_s = 2.0;
  Flight flight(DrawnWorld{{Block{{3.2, -40.0, 0.0}, {3.7, 40.0, 20.0}}}}, {0.0, 0.0, 2.0}, 0.0, parameters);
  flight.look();
  VehicleState state = flight.state();
  state.velocity_W_m_s = {4.0, 1.0, 0.0};
  const Goal goal = goalAt({50.0, 0.0, 2.0}, 6.0);
  const Decision braking = flight.planner().plan(flight.snapshot(), state, goal, flight.now());
  ASSERT_EQ(braking.reason, Reason::kBlocked);
  EXPECT_NEAR(braking.yaw_W_rad, std::atan2(1.0, 4.0), 0.01);

  state.velocity_W_m_s.setZero();
  state.T_W_B.translation_m.x() += 2.4;
  const Decision standing = flight.planner().plan(flight.snapshot(), state, goal, flight.now());
  ASSERT_EQ(standing.reason, Reason::kBlocked);
  EXPECT_NEAR(standing.yaw_W_rad, sweepOffset(flight.now(), parameters.heading), 1e-9);
}

TEST(Planner, ThePapersRuleChecksNoBrake) {
  PlannerParameters parameters = test::flightParameters();
  parameters.stop_check = StopCheck::kPaper;
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0, parameters);
  const Decision decision = flight.step(goalAt({50.0, 0.0, 2.0}));
  EXPECT_EQ(decision.reason, Reason::kFlying);
  EXPECT_FALSE(decision.brake_verified);
  EXPECT_EQ(decision.brake_risk, 1.0);
}

/// Fast towards a wall beyond the horizon of the primitives, with weak brakes: only the stop check sees the trap.
TEST(Planner, AMotionWhoseBrakeIsNotSafeIsNotFeasible) {
  PlannerParameters parameters = test::flightParameters();
  parameters.limits.horizontal_at_full_m_s2 = parameters.limits.horizontal_at_rest_m_s2;
  parameters.horizon.max_s = parameters.horizon.min_s;
  Flight flight(DrawnWorld{{Block{{8.5, -20.0, 0.0}, {9.0, 20.0, 12.0}}}}, {0.0, 0.0, 2.0}, 0.0, parameters);
  flight.look();
  VehicleState state = flight.state();
  state.velocity_W_m_s = {6.0, 0.0, 0.0};
  const Goal goal = goalAt({50.0, 0.0, 2.0}, 6.0);
  const Decision decision = flight.planner().plan(flight.snapshot(), state, goal, flight.now());
  EXPECT_GT(decision.vetoes.of_brakes, 0U);
  const Explanation explanation = flight.planner().explain(flight.snapshot(), state, goal, flight.now());
  int unsafe_brakes = 0;
  for (const CandidateExplanation& candidate : explanation.candidates) {
    if (candidate.verdict.motion.veto) continue;
    ASSERT_TRUE(candidate.verdict.stop);
    const bool stops = candidate.verdict.stop->risk <= 0.001 && candidate.verdict.stop->last.seenFree();
    EXPECT_EQ(candidate.verdict.vetoedByBrake(), !stops);
    if (candidate.verdict.stop->risk > 0.001 && candidate.verdict.stop->last.seenFree()) ++unsafe_brakes;
  }
  EXPECT_GT(unsafe_brakes, 0) << "the scene holds such motions";

  parameters.stop_check = StopCheck::kPaper;
  EXPECT_EQ(Planner(parameters).plan(flight.snapshot(), state, goal, flight.now()).reason, Reason::kFlying);
}

/// It is the camera that is turned to the goal, wherever it is mounted.
TEST(Planner, ACameraThatLooksAsideIsTurnedToTheGoal) {
  const double mount_yaw_rad = 0.5;
  CameraParameters camera = test::flightCamera();
  camera.T_B_C.rotation = Quat(Eigen::AngleAxisd(mount_yaw_rad, Vec3::UnitZ())) * camera.T_B_C.rotation;
  PlannerParameters parameters = test::flightParameters();
  parameters.heading.reach_s = 2.0;
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0, parameters, camera);
  const double bearing_rad = 2.4;
  const Decision decision = flight.step(goalAt({20.0 * std::cos(bearing_rad), 20.0 * std::sin(bearing_rad), 2.0}));
  EXPECT_EQ(decision.reason, Reason::kTurning);
  EXPECT_NEAR(decision.yaw_W_rad, bearing_rad - mount_yaw_rad, 1e-9);
}

/// A prior of zero lets the motion pass; the end of its brake must have been seen as free all the same.
TEST(Planner, ABrakeMustEndInSpaceSeenAsFreeWhateverThePriorsAre) {
  PlannerParameters parameters = test::flightParameters();
  parameters.risk.prior.fill(0.0);
  Flight flight(DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0, parameters);
  flight.look();
  VehicleState state = flight.state();
  state.velocity_W_m_s = {-6.0, 0.0, 0.0};
  const Decision decision = flight.planner().plan(flight.snapshot(), state, goalAt({-50.0, 0.0, 2.0}), flight.now());
  EXPECT_EQ(decision.reason, Reason::kNothingVerified);
  EXPECT_EQ(decision.vetoes.of_brakes, kCandidateCount);
}

}  // namespace
}  // namespace nanomap
