#include "tools/simulation/vio.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nanomap::simulation {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Duration kPeriod = std::chrono::milliseconds(10);
constexpr Time kStart = Time{std::chrono::milliseconds(1'999'800)};  // a second boundary lies 200 ms ahead

/// Flies along x at 5 m/s.
VehicleState truthAt(Time stamp) {
  VehicleState truth;
  truth.T_W_B = {Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ())), Vec3(5.0 * toSeconds(stamp - kStart), 1.0, 2.0)};
  truth.velocity_W_m_s = {5.0, 0.0, 0.0};
  return truth;
}

VioParameters driftOf(double horizontal_std_m, double vertical_std_m) {
  VioParameters parameters;
  parameters.drift.horizontal_std_m = horizontal_std_m;
  parameters.drift.vertical_std_m = vertical_std_m;
  return parameters;
}

std::vector<VioEstimate> run(VioSimulator& vio, int periods, Time from = kStart) {
  std::vector<VioEstimate> estimates;
  for (int i = 0; i < periods; ++i) estimates.push_back(vio.estimate(from + i * kPeriod, truthAt(from + i * kPeriod)));
  return estimates;
}

Vec3 errorOf(const VioEstimate& estimate) {
  return estimate.pose.T_W_B.translation_m - truthAt(estimate.pose.stamp).T_W_B.translation_m;
}

/// Standard deviation, over many seeds, of the error gained between two periods of a flight.
Vec3 gainedErrorStd(const VioParameters& parameters, int from, int to) {
  constexpr std::uint64_t kFlights = 2000;
  Vec3 sum_m2 = Vec3::Zero();
  for (std::uint64_t seed = 0; seed < kFlights; ++seed) {
    VioSimulator vio(parameters, seed);
    const std::vector<VioEstimate> estimates = run(vio, to + 1);
    sum_m2 += (errorOf(estimates[static_cast<std::size_t>(to)]) - errorOf(estimates[static_cast<std::size_t>(from)]))
                  .cwiseAbs2();
  }
  return (sum_m2 / static_cast<double>(kFlights)).cwiseSqrt();
}

// Five standard errors of a standard deviation estimated from 2000 flights.
constexpr double kTolerance = 5.0 / 63.2;

class DriftAfterFiveSeconds : public testing::TestWithParam<VioParameters> {};

INSTANTIATE_TEST_SUITE_P(Vio, DriftAfterFiveSeconds, testing::ValuesIn([] {
                           VioParameters smooth = driftOf(0.7, 0.2);
                           VioParameters walk = smooth;
                           walk.velocity_memory = Duration::zero();
                           VioParameters linear = smooth;
                           linear.drift.law = GrowthLaw::kLinear;
                           return std::vector{smooth, walk, linear};
                         }()));

TEST_P(DriftAfterFiveSeconds, HasTheConfiguredStandardDeviationAtAnyTime) {
  for (const int from : {0, 170}) {
    const Vec3 std_m = gainedErrorStd(GetParam(), from, from + 500);
    EXPECT_NEAR(std_m.x(), 0.7, 0.7 * kTolerance);
    EXPECT_NEAR(std_m.y(), 0.7, 0.7 * kTolerance);
    EXPECT_NEAR(std_m.z(), 0.2, 0.2 * kTolerance);
  }
}

TEST(Vio, DriftFollowsItsGrowthLaw) {
  VioParameters walk = driftOf(0.7, 0.0);
  walk.velocity_memory = Duration::zero();
  EXPECT_NEAR(gainedErrorStd(walk, 0, 125).x(), 0.7 * std::sqrt(0.25), 0.7 * kTolerance * 0.5);
  VioParameters linear = driftOf(0.7, 0.0);
  linear.drift.law = GrowthLaw::kLinear;
  EXPECT_NEAR(gainedErrorStd(linear, 0, 125).x(), 0.7 * 0.25, 0.7 * kTolerance * 0.25);
}

TEST(Vio, IncrementCovariancesAddUpToTheConfiguredDrift) {
  VioSimulator vio(driftOf(0.7, 0.2), 1);
  Mat3 sum_m2 = Mat3::Zero();
  Duration spanned{};
  const std::vector<VioEstimate> estimates = run(vio, 501);
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    ASSERT_TRUE(estimates[i].pose.increment);
    sum_m2 += estimates[i].pose.increment->covariance_W_m2;
    spanned += estimates[i].pose.increment->interval;
  }
  EXPECT_EQ(spanned, std::chrono::seconds(5));
  EXPECT_TRUE(sum_m2.isApprox(Vec3(0.49, 0.49, 0.04).asDiagonal().toDenseMatrix(), 1e-9)) << sum_m2;
}

TEST(Vio, CorrelatedIncrementsAreNotGivenAsIndependentOnes) {
  VioParameters parameters = driftOf(0.7, 0.2);
  parameters.drift.law = GrowthLaw::kLinear;
  VioSimulator vio(parameters, 1);
  EXPECT_FALSE(run(vio, 1).front().pose.increment);
}

TEST(Vio, WithoutDriftIsTheTruth) {
  VioSimulator vio(driftOf(0.0, 0.0), 1);
  for (const VioEstimate& estimate : run(vio, 300)) {
    EXPECT_EQ(errorOf(estimate), Vec3::Zero());
    EXPECT_EQ(estimate.velocity_W_m_s, Vec3(5.0, 0.0, 0.0));
  }
}

TEST(Vio, VelocityIsWrongAsThePositionMoves) {
  VioSimulator vio(driftOf(0.7, 0.2), 1);
  const std::vector<VioEstimate> estimates = run(vio, 100);
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    const Vec3 moved_m = estimates[i].pose.T_W_B.translation_m - estimates[i - 1].pose.T_W_B.translation_m;
    EXPECT_TRUE((moved_m / toSeconds(kPeriod)).isApprox(estimates[i].velocity_W_m_s, 1e-6));
  }
}

TEST(Vio, SequenceCountsEstimates) {
  VioSimulator vio(driftOf(0.1, 0.1), 1);
  const std::vector<VioEstimate> estimates = run(vio, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(estimates[i].pose.sequence, i);
}

TEST(Vio, SameSeedRepeatsAnotherDoesNot) {
  const auto lastError = [](std::uint64_t seed) {
    VioSimulator vio(driftOf(0.7, 0.2), seed);
    return errorOf(run(vio, 100).back());
  };
  EXPECT_EQ(lastError(3), lastError(3));
  EXPECT_NE(lastError(3), lastError(4));
}

TEST(Vio, CorrectionBringsTheWindowToTheTruth) {
  VioSimulator vio(driftOf(0.7, 0.2), 1);
  const std::vector<VioEstimate> estimates = run(vio, 1000);
  const Correction correction = vio.correct();
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kAccepted);
  EXPECT_EQ(correction.epoch, 0U);
  ASSERT_GE(correction.poses.size(), 50U);
  const Time newest = estimates.back().pose.stamp;
  EXPECT_LE(newest - correction.poses.back().stamp, std::chrono::milliseconds(100));
  EXPECT_LE(newest - correction.poses.front().stamp, std::chrono::milliseconds(5100));
  EXPECT_GE(newest - correction.poses.front().stamp, std::chrono::milliseconds(4900));
  for (const CorrectedPose& corrected : correction.poses) {
    EXPECT_EQ(corrected.T_W_B.translation_m, truthAt(corrected.stamp).T_W_B.translation_m);
    // Each corrects a pose that was given, at exactly its stamp.
    EXPECT_EQ((corrected.stamp - kStart) % kPeriod, Duration::zero());
  }
}

TEST(Vio, CorrectionBeforeAnyEstimateIsEmpty) {
  VioSimulator vio(driftOf(0.7, 0.2), 1);
  EXPECT_THAT(vio.correct().poses, testing::IsEmpty());
}

TEST(Vio, CorrectionsCountUp) {
  VioSimulator vio(driftOf(0.7, 0.2), 1);
  (void)run(vio, 10);
  const std::uint64_t first = vio.correct().sequence;
  EXPECT_GT(vio.correct().sequence, first);
}

TEST(Vio, JumpMovesTheWorldHorizontallyAndRaisesTheEpoch) {
  VioSimulator vio(driftOf(0.0, 0.0), 1);
  (void)run(vio, 10);
  vio.jump(1.5);
  const VioEstimate after = run(vio, 1, kStart + 10 * kPeriod).front();
  EXPECT_EQ(after.pose.epoch, 1U);
  EXPECT_NEAR(errorOf(after).norm(), 1.5, 1e-9);
  EXPECT_EQ(errorOf(after).z(), 0.0);
  const Correction correction = vio.correct();
  EXPECT_EQ(correction.epoch, 1U);
  EXPECT_EQ(correction.poses.front().stamp, kStart);  // poses from before the jump, in the new world
}

TEST(Vio, WrongParametersAreNamed) {
  VioParameters parameters = driftOf(0.7, 0.2);
  parameters.period = Duration::zero();
  EXPECT_THAT([&] { VioSimulator(parameters, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("vio: period")));
  parameters = driftOf(std::numeric_limits<double>::quiet_NaN(), 0.2);
  EXPECT_THAT([&] { VioSimulator(parameters, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("horizontal_std_m")));
  parameters = driftOf(0.7, 0.2);
  parameters.velocity_memory = -kPeriod;
  EXPECT_THAT([&] { VioSimulator(parameters, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("velocity_memory")));
  parameters = driftOf(0.7, 0.2);
  parameters.drift.after = kPeriod / 2;
  EXPECT_THAT([&] { VioSimulator(parameters, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("drift.after")));
}

}  // namespace
}  // namespace nanomap::simulation
