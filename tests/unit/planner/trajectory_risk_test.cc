#include "planner/trajectory_risk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/brake.h"
#include "planner/candidates.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

using test::Block;
using test::DrawnWorld;
using test::Flight;

/// At constant velocity from 2 m above the origin, for two seconds.
Trajectory straight(const Vec3& velocity_W_m_s) {
  Trajectory trajectory(Time{}, Motion{{0.0, 0.0, 2.0}, velocity_W_m_s, Vec3::Zero()});
  trajectory.append(2.0, Vec3::Zero());
  return trajectory;
}

struct Seen {
  explicit Seen(DrawnWorld world) : flight(std::move(world), {0.0, 0.0, 2.0}, 0.0) { flight.look(); }
  [[nodiscard]] SpaceAhead space() const { return {flight.snapshot(), flight.planner().parameters().risk}; }
  Flight flight;
};

TEST(SpaceAhead, AWayThroughTheOpenCarriesNoRisk) {
  const Seen seen(DrawnWorld{});
  const TrajectoryRisk risk = seen.space().assess(straight({4.0, 0.0, 0.0}), 20, true);
  EXPECT_LT(risk.risk, 1e-9);
  EXPECT_FALSE(risk.veto);
  EXPECT_DOUBLE_EQ(risk.last.elapsed_s, 2.0);
  EXPECT_TRUE(risk.last.seenFree());
}

TEST(SpaceAhead, AWayIntoAWallIsVetoedByTheWallsPoints) {
  const Seen seen(DrawnWorld{{Block{{5.0, -5.0, 0.0}, {6.0, 5.0, 8.0}}}});
  const TrajectoryRisk risk = seen.space().assess(straight({2.4, 0.0, 0.0}), 20, true);
  ASSERT_TRUE(risk.veto);
  EXPECT_FALSE(risk.veto->status);
  EXPECT_LT(risk.last.elapsed_s, 2.0) << "evaluation stopped early";
}

TEST(SpaceAhead, AWayOutOfTheViewIsVetoedByItsStatus) {
  const Seen seen(DrawnWorld{});
  const TrajectoryRisk risk = seen.space().assess(straight({0.0, 3.0, 0.0}), 20, true);
  ASSERT_TRUE(risk.veto);
  EXPECT_TRUE(risk.veto->status == Status::kBehind || risk.veto->status == Status::kOutsideFov);
}

TEST(SpaceAhead, InsideTheBubbleOnlyNeighboursJudge) {
  const Seen seen(DrawnWorld{});
  const SampleEvidence here = seen.space().assess(Motion{{-0.3, 0.0, 2.0}, Vec3::Zero(), Vec3::Zero()}, 0.0);
  EXPECT_TRUE(here.in_bubble);
  EXPECT_EQ(here.status, Status::kBehind);
  EXPECT_EQ(here.risk, 0.0);
  EXPECT_TRUE(here.seenFree());

  const Seen before_wall(DrawnWorld{{Block{{0.5, -5.0, 0.0}, {1.0, 5.0, 8.0}}}});
  const SampleEvidence touching = before_wall.space().assess(Motion{{0.3, 0.0, 2.0}, Vec3::Zero(), Vec3::Zero()}, 0.0);
  EXPECT_TRUE(touching.in_bubble);
  EXPECT_EQ(touching.risk, 1.0);
}

/// Beside a post's shadow: what the post hides is no obstacle to the nearest neighbour, and one to a certificate.
TEST(SpaceAhead, ACertificateIsDemandedOfSpaceThatMayHideSomething) {
  const Seen seen(
      DrawnWorld{{Block{{1.5, -0.75, 0.0}, {1.7, -0.6, 8.0}}, Block{{9.0, -20.0, 0.0}, {9.5, 20.0, 20.0}}}});
  const Motion beside_shadow{{5.0, -1.2, 2.0}, Vec3::Zero(), Vec3::Zero()};
  const Motion in_the_open{{5.0, 1.5, 2.0}, Vec3::Zero(), Vec3::Zero()};
  RiskParameters parameters = seen.flight.planner().parameters().risk;
  EXPECT_LT(seen.space().assess(beside_shadow, 0.0).risk, 1e-9);
  EXPECT_EQ(seen.space().assess(beside_shadow, 0.0).unseen_probability, 0.0);

  parameters.demand_certificate = true;
  const SpaceAhead certified(seen.flight.snapshot(), parameters);
  const SampleEvidence hidden = certified.assess(beside_shadow, 0.0);
  EXPECT_EQ(hidden.status, Status::kFree);
  EXPECT_GT(hidden.unseen_probability, 0.001);
  EXPECT_EQ(hidden.risk, hidden.unseen_probability);
  EXPECT_LT(certified.assess(in_the_open, 0.0).risk, 1e-9);

  Trajectory towards_shadow(Time{}, Motion{{5.0, 0.0, 2.0}, {0.0, -0.7, 0.0}, Vec3::Zero()});
  towards_shadow.append(2.0, Vec3::Zero());
  EXPECT_FALSE(seen.space().assess(towards_shadow, 20, true).veto);
  const TrajectoryRisk through = certified.assess(towards_shadow, 20, true);
  ASSERT_TRUE(through.veto);
  EXPECT_EQ(through.veto->status, Status::kPartial);
  const Motion nearer{{1.9, -0.5, 2.0}, Vec3::Zero(), Vec3::Zero()};
  EXPECT_EQ(certified.assess(nearer, 0.0).unseen_probability, 0.0) << "a camera cannot vouch for what is beside it";
  parameters.certificate_beyond_m = 1.0;
  EXPECT_GT(certified.assess(nearer, 0.0).unseen_probability, 0.001);
}

/// A wall on the left, seen by a first look to the left; a second one, ahead and to the right, sees the way along the
/// wall and none of the wall.
struct SeenTwice {
  SeenTwice() {
    const std::shared_ptr<const CameraModel> camera = test::model(test::flightCamera());
    const DrawnWorld world{{Block{{0.5, 0.45, 0.0}, {8.0, 0.6, 8.0}}, Block{{10.0, -30.0, 0.0}, {10.5, 30.0, 20.0}}}};
    Chain chain(ChainParameters{});
    Time stamp(std::chrono::seconds(1));
    for (const double yaw_W_rad : {0.5, -0.7}) {
      const Pose T_W_B{Quat(Eigen::AngleAxisd(yaw_W_rad, Vec3::UnitZ())), {0.0, 0.0, 2.0}};
      (void)chain.addPose({.stamp = stamp, .T_W_B = T_W_B, .increment = {}});
      (void)chain.addView(test::viewOf(world.seenBy(*camera, T_W_B, stamp), camera));
      stamp += std::chrono::milliseconds(100);
    }
    snapshot = chain.snapshot();
    parameters = test::flightParameters().risk;
  }

  [[nodiscard]] SpaceAhead space() const { return {snapshot, parameters}; }

  ChainSnapshot snapshot;
  RiskParameters parameters;
};

TEST(SpaceAhead, WhatLiesJustBesideTheViewThatAnswersIsSeenInAnother) {
  SeenTwice seen;
  const Motion along{{2.5, 0.0, 2.0}, Vec3::Zero(), Vec3::Zero()};
  SampleEvidence sample = seen.space().assess(along, 0.0);
  EXPECT_EQ(sample.status, Status::kFree);
  EXPECT_EQ(sample.view_index, 0U);
  EXPECT_LT(sample.risk, 1e-9) << "the paper's answer";
  EXPECT_TRUE(sample.cramped);

  seen.space().lookBeside(along, sample);
  EXPECT_FALSE(sample.cramped);
  EXPECT_EQ(sample.beside.view_index, 1U);
  ASSERT_TRUE(sample.beside.nearest_m);
  EXPECT_NEAR(*sample.beside.nearest_m, 0.45, 0.02);
  EXPECT_NEAR(sample.distance_m(), 0.45, 0.02);
  EXPECT_GT(sample.risk, 0.01);
  EXPECT_NEAR(sample.risk, sample.beside.collision_probability, 1e-12);

  const Motion aside{{2.5, -1.5, 2.0}, Vec3::Zero(), Vec3::Zero()};
  EXPECT_FALSE(seen.space().assess(aside, 0.0).cramped) << "there is room";
  const Motion outside{{0.0, 2.5, 2.0}, Vec3::Zero(), Vec3::Zero()};
  EXPECT_FALSE(seen.space().assess(outside, 0.0).cramped) << "no view answers at all";
  seen.parameters.look_beside = false;
  EXPECT_FALSE(seen.space().assess(along, 0.0).cramped);
}

/// The same way, seen twice; the second time there is no depth straight ahead, and a post beside the way.
struct SeenWithAPostOnlyLast {
  SeenWithAPostOnlyLast() {
    const std::shared_ptr<const CameraModel> camera = test::model(test::flightCamera());
    const Block wall{{6.0, -20.0, 0.0}, {6.5, 20.0, 12.0}};
    const Block pane{{5.9, -0.3, 1.5}, {5.95, 0.3, 2.5}, true};
    const Block post{{2.9, 0.5, 0.0}, {3.1, 0.7, 8.0}};
    Chain chain(ChainParameters{});
    Time stamp(std::chrono::seconds(1));
    for (const DrawnWorld& world : {DrawnWorld{{wall}}, DrawnWorld{{wall, pane, post}}}) {
      const Pose T_W_B{Quat::Identity(), {0.0, 0.0, 2.0}};
      (void)chain.addPose({.stamp = stamp, .T_W_B = T_W_B, .increment = {}});
      (void)chain.addView(test::viewOf(world.seenBy(*camera, T_W_B, stamp), camera));
      stamp += std::chrono::milliseconds(100);
    }
    snapshot = chain.snapshot();
  }

  [[nodiscard]] SpaceAhead space() const { return {snapshot, parameters}; }

  ChainSnapshot snapshot;
  RiskParameters parameters = test::flightParameters().risk;
};

TEST(SpaceAhead, WhatANewerViewHasMeasuredCountsThoughAnOlderOneAnswers) {
  SeenWithAPostOnlyLast seen;
  const Motion beside_post{{3.0, 0.0, 2.0}, Vec3::Zero(), Vec3::Zero()};
  SampleEvidence sample = seen.space().assess(beside_post, 0.0);
  ASSERT_EQ(sample.status, Status::kFree);
  ASSERT_EQ(sample.view_index, 1U) << "the newest has no depth there";
  EXPECT_LT(sample.risk, 1e-9) << "the paper's answer";
  EXPECT_TRUE(sample.overtaken);

  seen.space().lookBeside(beside_post, sample);
  EXPECT_FALSE(sample.overtaken);
  EXPECT_FALSE(sample.beside.asked) << "there is room";
  EXPECT_EQ(sample.newer.view_index, 0U);
  ASSERT_TRUE(sample.newer.nearest_m);
  EXPECT_NEAR(*sample.newer.nearest_m, 0.5, 0.03);
  EXPECT_NEAR(sample.distance_m(), 0.5, 0.03);
  EXPECT_GT(sample.risk, 0.001);
  EXPECT_NEAR(sample.risk, sample.newer.collision_probability, 1e-12);

  const Motion off_the_gap{{3.0, -1.5, 2.0}, Vec3::Zero(), Vec3::Zero()};
  EXPECT_FALSE(seen.space().assess(off_the_gap, 0.0).overtaken) << "the newest answers itself";

  Trajectory past(Time{}, Motion{{2.0, 0.0, 2.0}, {1.0, 0.0, 0.0}, Vec3::Zero()});
  past.append(1.5, Vec3::Zero());
  TrajectoryRisk risk = seen.space().assess(past, 20, false);
  EXPECT_FALSE(risk.veto);
  EXPECT_NE(risk.second_looks, 0U);
  seen.space().lookBeside(past, 20, false, risk);
  ASSERT_TRUE(risk.veto);
  EXPECT_FALSE(risk.veto->status) << "measured points";

  seen.parameters.look_beside = false;
  EXPECT_FALSE(seen.space().assess(beside_post, 0.0).needsSecondLook());
}

TEST(SpaceAhead, FarAwayAPlaceThatNoViewHasRoomAroundIsRefused) {
  SeenTwice seen;
  const double edge_rad = -0.7 - 0.785 + 0.06;  // just inside the second look's right edge
  const auto at = [&](double distance_m) {
    return Motion{{distance_m * std::cos(edge_rad), distance_m * std::sin(edge_rad), 2.0}, Vec3::Zero(), Vec3::Zero()};
  };
  for (const double distance_m : {2.8, 3.2}) {
    SampleEvidence sample = seen.space().assess(at(distance_m), 0.0);
    ASSERT_TRUE(endsSearch(sample.status));
    ASSERT_TRUE(sample.cramped);
    seen.space().lookBeside(at(distance_m), sample);
    EXPECT_FALSE(sample.beside.view_index);
    EXPECT_EQ(sample.unseen_probability, distance_m > 3.0 ? 1.0 : 0.0);
    EXPECT_EQ(sample.risk > 0.5, distance_m > 3.0);
  }
  Trajectory way(Time{}, Motion{at(2.5).position_m, at(1.0).position_m - Vec3(0.0, 0.0, 2.0), Vec3::Zero()});
  way.append(1.0, Vec3::Zero());
  TrajectoryRisk risk = seen.space().assess(way, 20, false);
  EXPECT_FALSE(risk.veto);
  seen.space().lookBeside(way, 20, false, risk);
  ASSERT_TRUE(risk.veto);
  EXPECT_EQ(risk.veto->status, Status::kPartial);
  EXPECT_EQ(risk.risk, 1.0);
}

TEST(SpaceAhead, AWayIsVetoedByWhatLiesBesideIt) {
  const SeenTwice seen;
  Trajectory way(Time{}, Motion{{1.8, -0.6, 2.0}, {0.8, 0.3, 0.0}, Vec3::Zero()});
  way.append(2.0, Vec3::Zero());
  std::vector<SampleEvidence> evidence;
  TrajectoryRisk risk = seen.space().assess(way, 20, false, &evidence);
  const TrajectoryRisk answered = risk;
  EXPECT_FALSE(answered.veto);
  EXPECT_NE(answered.second_looks, 0U);
  EXPECT_TRUE(answered.last.cramped);

  seen.space().lookBeside(way, 20, false, risk, &evidence);
  ASSERT_TRUE(risk.veto);
  EXPECT_FALSE(risk.veto->status) << "measured points";
  EXPECT_EQ(risk.second_looks, 0U);
  EXPECT_NEAR(risk.least_distance_m, 0.45, 0.02);
  EXPECT_EQ(risk.last.beside.view_index, 1U);
  EXPECT_EQ(risk.last.elapsed_s, 2.0);
  EXPECT_EQ(risk.first.elapsed_s, 0.0);
  double survival = 1.0;
  for (const SampleEvidence& sample : evidence) survival *= 1.0 - sample.risk;
  EXPECT_NEAR(risk.risk, 1.0 - survival, 1e-12);
  EXPECT_EQ(evidence.back().beside.view_index, 1U);

  SeenTwice uncertain;
  uncertain.parameters.prior[static_cast<std::size_t>(Status::kFree)] = 0.02;
  evidence.clear();
  TrajectoryRisk mixed = uncertain.space().assess(way, 20, false, &evidence);
  uncertain.space().lookBeside(way, 20, false, mixed, &evidence);
  survival = 1.0;
  for (const SampleEvidence& sample : evidence) survival *= 1.0 - sample.risk;
  EXPECT_NEAR(mixed.risk, 1.0 - survival, 1e-12) << "what a sample was worth before is not counted twice";

  // More samples than a mask has bits: the last bit stands for all that follow.
  evidence.clear();
  TrajectoryRisk fine = seen.space().assess(way, 200, false, &evidence);
  ASSERT_GT(evidence.size(), 200U);
  seen.space().lookBeside(way, 200, false, fine, &evidence);
  EXPECT_TRUE(fine.veto);
  survival = 1.0;
  for (const SampleEvidence& sample : evidence) {
    EXPECT_FALSE(sample.cramped);
    survival *= 1.0 - sample.risk;
  }
  EXPECT_NEAR(fine.risk, 1.0 - survival, 1e-12);

  TrajectoryRisk hasty = answered;
  seen.space().lookBeside(way, 20, true, hasty);
  EXPECT_TRUE(hasty.veto);
  EXPECT_LE(hasty.risk, risk.risk);
}

/// The brake is its own motion, and judged once: if that is vetoed there is no stop left to be blamed.
TEST(SpaceAhead, TheBrakeIsVetoedByWhatLiesBesideItAndBlamesNoStop) {
  SeenTwice seen;
  PlannerParameters parameters = test::flightParameters();
  const PrimitiveLibrary library;
  const auto candidatesAt = [&](double y_m, double velocity_y_m_s) {
    const Motion start{{2.2, y_m, 2.0}, {0.6, velocity_y_m_s, 0.0}, Vec3::Zero()};
    return Candidates(parameters, library, seen.snapshot, test::goalAt({20.0, 0.0, 2.0}), seen.snapshot.stamp, start,
                      -0.7);
  };
  const Candidates towards_wall = candidatesAt(-0.1, 0.9);
  Verdict brake = towards_wall.judge(kBrake, false);
  ASSERT_FALSE(brake.veto);
  ASSERT_TRUE(brake.stop);
  towards_wall.lookBeside(kBrake, false, brake);
  ASSERT_TRUE(brake.veto);
  EXPECT_FALSE(brake.stop);
  EXPECT_FALSE(brake.vetoedByBrake());

  const Candidates along_wall = candidatesAt(-0.6, -0.4);
  Verdict clear = along_wall.judge(kBrake, false);
  along_wall.lookBeside(kBrake, false, clear);
  EXPECT_FALSE(clear.veto);
  ASSERT_TRUE(clear.stop);
  EXPECT_EQ(clear.stop->risk, clear.motion.risk);
}

TEST(SpaceAhead, DeviationGrowsWithSpeedAndTime) {
  const DeviationGrowth growth{.base_m = 0.1, .per_speed_s = 0.02, .per_time_m_s = 0.03};
  EXPECT_DOUBLE_EQ(growth.at(0.0, 0.0), 0.1);
  EXPECT_DOUBLE_EQ(growth.at(5.0, 2.0), 0.1 + 0.1 + 0.06);
  const Seen seen(DrawnWorld{{Block{{5.0, -5.0, 0.0}, {6.0, 5.0, 8.0}}}});
  const Vec3 p_W(4.3, 0.0, 2.0);
  const auto riskAt = [&](double speed_m_s, double elapsed_s) {
    return seen.space().assess(Motion{p_W, {speed_m_s, 0.0, 0.0}, Vec3::Zero()}, elapsed_s).collision_probability;
  };
  EXPECT_LT(riskAt(0.0, 0.0), riskAt(5.0, 0.0));
  EXPECT_LT(riskAt(0.0, 0.0), riskAt(0.0, 2.0));
}

/// A thin pole between two samples of a fast motion: the samples alone would pass it by.
TEST(SpaceAhead, SamplesAreInsertedWhereSomethingIsNear) {
  const Seen seen(DrawnWorld{{Block{{4.0, -0.15, 0.0}, {4.3, 0.15, 8.0}}}});
  RiskParameters parameters = seen.flight.planner().parameters().risk;
  parameters.prior.fill(0.0);
  const SpaceAhead space(seen.flight.snapshot(), parameters);
  std::vector<SampleEvidence> evidence;
  const TrajectoryRisk risk = space.assess(straight({3.0, 0.0, 0.0}), 2, false, &evidence);
  EXPECT_TRUE(risk.veto);
  EXPECT_GT(evidence.size(), 3U);
  EXPECT_DOUBLE_EQ(risk.last.elapsed_s, 2.0);

  const Seen empty(DrawnWorld{});
  evidence.clear();
  (void)empty.space().assess(straight({1.0, 0.0, 0.0}), 2, false, &evidence);
  EXPECT_EQ(evidence.size(), 7U) << "two steps of a metre, each in parts of at most 0.4 m";
}

/// Fast, gaining speed, in a turn, and braking: what is evenly spaced in time is not in space.
TEST(SpaceAhead, NoTwoSamplesAreFartherApartThanTheVehiclesRadius) {
  const Seen seen(DrawnWorld{});
  const PlannerParameters& parameters = seen.flight.planner().parameters();
  const PrimitiveTimes times = parameters.horizon.at(8.0);
  for (const double speed_m_s : {0.5, 5.0, 7.2, 8.0, 15.0}) {
    for (const Vec3& acceleration :
         {Vec3(0.0, 0.0, 0.0), Vec3(4.0, 0.0, 0.0), Vec3(-4.0, 1.0, 0.0), Vec3(0.0, 4.0, 2.0)}) {
      const Motion start{{0.0, 0.0, 2.0}, {speed_m_s, 0.0, 0.0}, Vec3::Zero()};
      const Trajectory motion = primitive(Time{}, start, acceleration, times, parameters.limits);
      for (const Trajectory& way : {motion, brakeAfter(motion, parameters.brake_after_s, parameters.limits)}) {
        for (const int samples : {1, 4, 10, 20, 23}) {
          std::vector<SampleEvidence> evidence;
          (void)seen.space().assess(way, samples, false, &evidence);
          ASSERT_GT(evidence.size(), static_cast<std::size_t>(samples));
          EXPECT_EQ(evidence.front().elapsed_s, 0.0);
          EXPECT_EQ(evidence.back().elapsed_s, way.duration_s());
          for (std::size_t i = 1; i < evidence.size(); ++i) {
            EXPECT_GT(evidence[i].elapsed_s, evidence[i - 1].elapsed_s);
            const double apart_m = (evidence[i].position_W_m - evidence[i - 1].position_W_m).norm();
            ASSERT_LE(apart_m, parameters.risk.collision.vehicle_radius_m)
                << speed_m_s << " m/s, " << acceleration.transpose() << ", " << samples << " samples, the " << i
                << "th";
          }
        }
      }
    }
  }
}

TEST(SpaceAhead, AKnownStartTakesTheFirstSamplesPlace) {
  const Seen seen(DrawnWorld{{Block{{4.0, -3.0, 0.0}, {4.3, 3.0, 8.0}}}});
  const Trajectory way = straight({1.2, 0.0, 0.0});
  SampleEvidence start = seen.space().assess(way.atStart(), 0.0);
  const TrajectoryRisk alone = seen.space().assess(way, 20, false);
  std::vector<SampleEvidence> evidence;
  const TrajectoryRisk shared = seen.space().assess(way, 20, false, &evidence, &start);
  EXPECT_EQ(evidence.size(), 21U);
  EXPECT_EQ(shared.risk, alone.risk);
  EXPECT_EQ(shared.least_distance_m, alone.least_distance_m);
  EXPECT_EQ(shared.first.nearest_m, alone.first.nearest_m);

  start.risk = 1.0;
  EXPECT_EQ(seen.space().assess(way, 20, true, nullptr, &start).risk, 1.0) << "it is not asked for again";
}

TEST(SpaceAhead, AGlanceVetoesOnlyWhatAWholeLookVetoes) {
  const Seen seen(DrawnWorld{{Block{{5.0, -4.0, 0.0}, {5.3, -2.0, 8.0}}}});
  const SpaceAhead space = seen.space();
  constexpr int kSamples = 23;  // no multiple of the glances
  int vetoed = 0;
  int glanced = 0;
  for (double course_rad = -1.5; course_rad < 1.5; course_rad += 0.02) {
    const Trajectory way = straight({3.0 * std::cos(course_rad), 3.0 * std::sin(course_rad), 0.0});
    std::vector<SampleEvidence> evidence;
    const bool is_vetoed = space.assess(way, kSamples, false, &evidence).veto.has_value();
    vetoed += is_vetoed ? 1 : 0;
    const std::optional<TrajectoryRisk> glance = space.glance(way, kSamples);
    if (!glance) continue;
    ++glanced;
    EXPECT_TRUE(is_vetoed);
    EXPECT_TRUE(glance->veto);
    const auto isGlanced = [&](const SampleEvidence& sample) { return sample.elapsed_s == glance->first.elapsed_s; };
    EXPECT_EQ(std::ranges::count_if(evidence, isGlanced), 1) << "a sample of the whole look";
  }
  EXPECT_LT(vetoed, 140) << "some ways are open";
  EXPECT_GT(glanced, vetoed * 9 / 10);
  EXPECT_GT(glanced, 50);
}

TEST(SpaceAhead, RiskIsThatOfIndependentSamples) {
  const Seen seen(DrawnWorld{});
  RiskParameters parameters = seen.flight.planner().parameters().risk;
  parameters.prior.fill(0.1);
  parameters.bubble_margin_m = 0.0;
  const SpaceAhead space(seen.flight.snapshot(), parameters);
  const TrajectoryRisk risk = space.assess(straight({2.4, 0.0, 0.0}), 15, false);
  EXPECT_NEAR(risk.risk, 1.0 - std::pow(0.9, 14), 1e-12) << "all but the start and 0.32 m are outside of the bubble";
}

/// Half-space risk of a plane depends on the deviation along its normal alone: of the ground, on the vertical one,
/// however the body is pitched.
TEST(SpaceAhead, DeviationStaysLevelWhenTheBodyPitches) {
  const auto groundRisk = [](double pitch_rad, double horizontal_m, double vertical_m) {
    Seen seen(DrawnWorld{});
    ChainSnapshot snapshot = seen.flight.snapshot();
    const Mat3 R_B_L = Eigen::AngleAxisd(-pitch_rad, Vec3::UnitY()).toRotationMatrix();
    snapshot.T_W_B.rotation = Quat(R_B_L.transpose());  // the body pitches, the view stays where it is in W
    for (SnapshotView& view : snapshot.views) view.R_C_B *= R_B_L.transpose();
    RiskParameters parameters = seen.flight.planner().parameters().risk;
    parameters.collision.model = CollisionModel::kHalfSpaces;
    parameters.horizontal = {.base_m = horizontal_m};
    parameters.vertical = {.base_m = vertical_m};
    parameters.query.k = 1;
    const SpaceAhead space(snapshot, parameters);
    return space.assess(Motion{{6.0, 0.0, 0.6}, Vec3::Zero(), Vec3::Zero()}, 0.0).collision_probability;
  };
  const double level = groundRisk(0.0, 0.1, 0.2);
  EXPECT_GT(level, 0.01);
  EXPECT_LT(groundRisk(0.0, 0.1, 0.05), level / 2.0) << "the vertical deviation matters";
  for (const double pitch_rad : {-0.7, 0.4}) EXPECT_NEAR(groundRisk(pitch_rad, 0.1, 0.2), level, 1e-6);
}

}  // namespace
}  // namespace nanomap
