#include "drivers/mavlink/alignment_estimator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/unit/drivers/mavlink/alignment_pairs.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::trueAlignment;
using test::TwoEstimators;

/// Two estimators of one vehicle, at 100 Hz and 50 Hz, and the alignment that is made of them.
class Flight {
 public:
  explicit Flight(double speed_m_s = 2.0) : estimators(speed_m_s) {
    estimators.position_noise_m = 0.05;
    estimators.heading_noise_rad = 0.02;
  }

  TwoEstimators estimators;
  AlignmentEstimator alignment{AlignmentParameters{}};
  double largest_step_m = 0.0;  ///< of the vehicle's setpoint, had it been where the vehicle is

  void fly(Duration duration) {
    for (const Time end = now_ + duration; now_ < end; now_ += 10ms) {
      const BodyPose pose = estimators.world(now_);
      const Alignment before = result();
      alignment.addWorldPose(pose);
      if (now_.time_since_epoch() % 20ms == 0ms) alignment.addAutopilotPose(estimators.autopilot(now_));
      const Alignment after = result();
      if (!before.T_NED_W || !after.T_NED_W) continue;
      const Vec3& at_W = pose.T_W_B.translation_m;
      largest_step_m = std::max(largest_step_m, (after.T_NED_W->point(at_W) - before.T_NED_W->point(at_W)).norm());
    }
  }

  [[nodiscard]] Alignment result(Duration later = 0ms) const { return alignment.alignment(now_ + later); }

  [[nodiscard]] double errorAtVehicle() {
    const BodyPose pose = estimators.world(now_);
    const Vec3 truth = estimators.T_NED_W.point((estimators.T_Wgiven_W.inverse() * pose.T_W_B).translation_m);
    return (result().T_NED_W->point(pose.T_W_B.translation_m) - truth).norm();
  }

 private:
  Time now_ = Time(100s);
};

TEST(AlignmentEstimator, KnowsNothingBeforeItHasPairs) {
  const Flight flight;
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kUnknown);
  EXPECT_FALSE(flight.result().T_NED_W);
}

TEST(AlignmentEstimator, FindsSeventyDegreesAndAnOffset) {
  Flight flight;
  flight.fly(900ms);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kUnknown);
  flight.fly(9s);
  const Alignment result = flight.result();
  EXPECT_EQ(result.verdict, AlignmentVerdict::kGood);
  EXPECT_NEAR(result.T_NED_W->heading_rad(), test::kHeading_rad, 0.02);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
  EXPECT_LT(result.position_residual_m, 0.2);
  EXPECT_EQ(result.jumps, 0U);
}

TEST(AlignmentEstimator, IsUnknownWhenEitherStreamEnds) {
  Flight flight;
  flight.fly(3s);
  EXPECT_EQ(flight.result(400ms).verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result(600ms).verdict, AlignmentVerdict::kUnknown);
  EXPECT_TRUE(flight.result(600ms).T_NED_W);  // the last one known: a brake without position can still use it
}

TEST(AlignmentEstimator, ToleratesLoneOutliers) {
  Flight flight;
  flight.fly(5s);
  for (int i = 0; i < 10; ++i) {
    flight.estimators.T_Wgiven_W.translation_m.x() = 8.0;
    flight.fly(60ms);
    flight.estimators.T_Wgiven_W.translation_m.x() = 0.0;
    flight.fly(500ms);
  }
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result().jumps, 0U);
  EXPECT_GT(flight.alignment.counters().outliers, 5U);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
}

TEST(AlignmentEstimator, FollowsASmallCorrectionSlowly) {
  Flight flight;
  flight.fly(10s);
  flight.largest_step_m = 0.0;
  flight.estimators.T_Wgiven_W =
      Pose{Quat(Eigen::AngleAxisd(0.05, Vec3::UnitZ())), Vec3(0.3, -0.3, 0.1)};  // a loop closure in flight
  flight.fly(15s);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result().jumps, 0U);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
  EXPECT_LE(flight.largest_step_m, 0.2 * 0.06 + 1e-9);  // 0.2 m/s, a pair every 60 ms
}

TEST(AlignmentEstimator, IsWhereADriftingWorldIsNow) {
  Flight flight;
  flight.fly(10s);
  constexpr double kDrift_m_s = 0.1;
  for (int i = 0; i < 1000; ++i) {
    flight.estimators.T_Wgiven_W.translation_m.x() += kDrift_m_s * 0.01;
    flight.fly(10ms);
  }
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result().jumps, 0U);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);  // half a window ago it was half a metre away
}

TEST(AlignmentEstimator, SaysHowFarWhatItGivesIsBehindWhatItKnows) {
  Flight flight;
  flight.fly(10s);
  flight.estimators.T_Wgiven_W.translation_m.x() = 0.9;  // below a jump
  flight.fly(1s);
  EXPECT_EQ(flight.result().jumps, 0U);
  EXPECT_GT(flight.errorAtVehicle(), 0.6);
  EXPECT_GT(flight.result().position_residual_m, 0.5);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kInconsistent);
  flight.fly(5s);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
}

TEST(AlignmentEstimator, SaysThatOneHasJumpedAndStartsAnew) {
  Flight flight;
  flight.fly(10s);
  flight.estimators.T_Wgiven_W = Pose{Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), Vec3(-4.0, 2.0, 0.0)};
  flight.fly(500ms);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kInconsistent);
  EXPECT_EQ(flight.result().jumps, 1U);
  EXPECT_LT(flight.errorAtVehicle(), 0.2);  // already told from what came since
  flight.fly(1500ms);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result().jumps, 1U);
  EXPECT_NEAR(wrapAngle(flight.result().T_NED_W->heading_rad() - test::kHeading_rad), 0.5, 0.05);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
}

TEST(AlignmentEstimator, FollowsTheAutopilotsOwnJump) {
  Flight flight;
  flight.fly(10s);
  flight.estimators.T_NED_W = NedFromWorld(test::kHeading_rad, Vec3(110.0, -20.0, 3.0));
  flight.fly(2s);
  EXPECT_EQ(flight.result().jumps, 1U);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
}

TEST(AlignmentEstimator, ForgetsEverythingInANewEpoch) {
  Flight flight;
  flight.fly(5s);
  flight.estimators.epoch = 1;
  flight.estimators.T_Wgiven_W = Pose{Quat::Identity(), Vec3(50.0, 0.0, 0.0)};
  flight.fly(200ms);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kUnknown);
  EXPECT_FALSE(flight.result().T_NED_W);
  flight.fly(2s);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kGood);
  EXPECT_EQ(flight.result().epoch, 1U);
  EXPECT_EQ(flight.result().jumps, 0U);
  EXPECT_LT(flight.errorAtVehicle(), 0.1);
}

TEST(AlignmentEstimator, SeesACompassThatContradictsTheTracks) {
  Flight flight;
  flight.estimators.compass_error_rad = 0.6;
  flight.fly(10s);
  EXPECT_EQ(flight.result().verdict, AlignmentVerdict::kInconsistent);
}

TEST(AlignmentEstimator, SeesAMirroredFrame) {
  Flight flight;
  for (Time now(100s); now < Time(110s); now += 20ms) {
    BodyPose pose = flight.estimators.world(now);
    pose.T_W_B.translation_m.y() *= -1.0;  // an FRD world that was taken for FLU
    pose.T_W_B.rotation.y() *= -1.0;
    pose.T_W_B.rotation.z() *= -1.0;
    flight.alignment.addWorldPose(pose);
    flight.alignment.addAutopilotPose(flight.estimators.autopilot(now));
    EXPECT_NE(flight.alignment.alignment(now).verdict, AlignmentVerdict::kGood) << toSeconds(now.time_since_epoch());
    if (now == Time(102s)) break;
  }
}

TEST(AlignmentEstimator, CountsPosesThatAreOfNoUse) {
  Flight flight;
  flight.fly(1s);
  const AlignmentCounters before = flight.alignment.counters();
  flight.alignment.addAutopilotPose(flight.estimators.autopilot(Time(100s)));  // backwards
  AutopilotPose nan = flight.estimators.autopilot(Time(200s));
  nan.heading_rad = std::numeric_limits<double>::quiet_NaN();
  flight.alignment.addAutopilotPose(nan);
  EXPECT_EQ(flight.alignment.counters().disordered, before.disordered + 2);
  for (int i = 0; i < 100; ++i) flight.alignment.addAutopilotPose(flight.estimators.autopilot(Time(102s + i * 20ms)));
  EXPECT_GT(flight.alignment.counters().dropped, 20U);  // the VIO is not there yet, and the queue is bounded
  flight.alignment.addWorldPose(flight.estimators.world(Time(200s)));
  EXPECT_GT(flight.alignment.counters().unmatched, 20U);  // it came back after a gap
}

TEST(AlignmentEstimator, NamesAParameterThatCannotBe) {
  const auto complaintOf = [](const AlignmentParameters& parameters) -> std::string {
    try {
      const AlignmentEstimator estimator(parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaintOf({.min_pairs = 1000}), testing::HasSubstr("window"));
  EXPECT_THAT(complaintOf({.place_window = 10ms}), testing::HasSubstr("place_window"));
  EXPECT_THAT(complaintOf({.place_window = 11s}), testing::HasSubstr("place_window"));
}

}  // namespace
}  // namespace nanomap
