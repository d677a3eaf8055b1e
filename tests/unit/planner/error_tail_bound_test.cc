#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>

#include "planner/collision_probability.h"

namespace nanomap {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kOracleTolerance = 1e-9;

/// P(z1^2 + z2^2 + z3^2 > x): the length of a standard normal vector.
double chiSquareThreeTail(double x) {
  return std::erfc(std::sqrt(0.5 * x)) + std::sqrt(2.0 * x / std::numbers::pi) * std::exp(-0.5 * x);
}

template <class Function>
double integrate(Function function, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(function, 0.0, to, 12, 0.1 * kOracleTolerance);
}

/// P(|e| > radius) to kOracleTolerance (relative): with e = Sigma^(1/2) rho u, u uniform on the sphere, it is the mean
/// over u of the tail of rho. Another route than the bound's: no axis is special, no limit has a case of its own.
double exactTail(const Vec3& variances_m2, double radius_m) {
  const auto overHeight = [&](double height) {
    const double planar = 1.0 - height * height;
    const auto overAngle = [&](double angle_rad) {
      const double cosine_sq = std::pow(std::cos(angle_rad), 2);
      const double variance_m2 = planar * (variances_m2[0] * cosine_sq + variances_m2[1] * (1.0 - cosine_sq)) +
                                 variances_m2[2] * height * height;
      return variance_m2 > 0.0 ? chiSquareThreeTail(radius_m * radius_m / variance_m2) : 0.0;
    };
    return integrate(overAngle, 0.5 * std::numbers::pi) / (0.5 * std::numbers::pi);
  };
  return integrate(overHeight, 1.0);
}

Mat3 rotated(const Vec3& variances_m2, const Quat& rotation) {
  const Mat3 R = rotation.toRotationMatrix();
  return R * variances_m2.asDiagonal() * R.transpose();
}

Mat3 diagonal(double x_m2, double y_m2, double z_m2) { return Vec3(x_m2, y_m2, z_m2).asDiagonal(); }

struct CovarianceClass {
  const char* name;
  Vec3 standard_deviations;   ///< relative to the largest
  double most_at_constraint;  ///< largest bound / exact where the exact probability is 1e-3, the planner's constraint
  double most_to_1e12;        ///< and over the whole grid, 1e-12 to 1
};

void PrintTo(const CovarianceClass& covariance, std::ostream* out) { *out << covariance.name; }

class ErrorTailBoundByClass : public testing::TestWithParam<CovarianceClass> {};

/// The table in collision_probability.h is what this test prints.
TEST_P(ErrorTailBoundByClass, IsNeverBelowTheExactTailAndNotLooserThanStated) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  double worst_at_constraint = 1.0;
  double worst = 1.0;
  for (const double scale_m : {1e-3, 0.3, 20.0}) {
    const Vec3 variances_m2 = (scale_m * GetParam().standard_deviations).array().square();
    for (double radius_sigmas = 0.05; radius_sigmas < 7.6; radius_sigmas += 0.15) {
      const double exact = exactTail(variances_m2, radius_sigmas * scale_m);
      const Quat rotation =
          Quat(coordinate(random), coordinate(random), coordinate(random), coordinate(random)).normalized();
      const double bound = errorTailBound(rotated(variances_m2, rotation), radius_sigmas * scale_m);
      EXPECT_GE(bound, exact * (1.0 - kOracleTolerance)) << radius_sigmas << " sigmas of " << scale_m << " m";
      EXPECT_LE(bound, 1.0);
      if (exact < 1e-12) continue;
      worst = std::max(worst, bound / exact);
      if (exact > 0.5e-3 && exact < 2e-3) worst_at_constraint = std::max(worst_at_constraint, bound / exact);
    }
  }
  EXPECT_LE(worst_at_constraint, GetParam().most_at_constraint);
  EXPECT_LE(worst, GetParam().most_to_1e12);
  std::printf("%-28s %.7f at 1e-3, %.7f down to 1e-12\n", GetParam().name, worst_at_constraint, worst);
}

INSTANTIATE_TEST_SUITE_P(
    CovarianceClasses, ErrorTailBoundByClass,
    testing::Values(CovarianceClass{"sphere", {1.0, 1.0, 1.0}, 1.000001, 1.000003},
                    CovarianceClass{"nearly a sphere", {1.0, 1.0 - 1e-9, 1.0 - 2e-9}, 1.000001, 1.000003},
                    CovarianceClass{"drift, vertical 4/7", {1.0, 1.0, 4.0 / 7.0}, 1.000001, 1.000003},
                    CovarianceClass{"drift, vertical 1/7", {1.0, 1.0, 1.0 / 7.0}, 1.000001, 1.000003},
                    CovarianceClass{"disc, singular", {1.0, 1.0, 0.0}, 1.000001, 1.000003},
                    CovarianceClass{"three axes 1, 0.9, 0.5", {1.0, 0.9, 0.5}, 1.18, 1.48},
                    CovarianceClass{"three axes 1, 0.5, 0.25", {1.0, 0.5, 0.25}, 1.51, 2.05},
                    CovarianceClass{"prolate 1, 0.5, 0.5", {1.0, 0.5, 0.5}, 1.51, 2.05},
                    CovarianceClass{"needle 1, 0.01, 0.01", {1.0, 0.01, 0.01}, 1.57, 2.30},
                    CovarianceClass{"line, singular", {1.0, 0.0, 0.0}, 1.57, 2.30}));

/// The oracle itself, where the tail has a closed form.
TEST(ExactTail, EqualsTheClosedFormsOfOneTwoAndThreeEqualAxes) {
  for (const double radius_m : {0.1, 1.0, 3.0, 7.0}) {
    EXPECT_NEAR(exactTail({1.0, 0.0, 0.0}, radius_m) / std::erfc(radius_m / std::numbers::sqrt2), 1.0, 1e-8);
    EXPECT_NEAR(exactTail({1.0, 1.0, 0.0}, radius_m) / std::exp(-0.5 * radius_m * radius_m), 1.0, 1e-8);
    EXPECT_NEAR(exactTail({1.0, 1.0, 1.0}, radius_m) / chiSquareThreeTail(radius_m * radius_m), 1.0, 1e-8);
  }
}

TEST(ErrorTailBound, IsCertainAtTheEnds) {
  EXPECT_EQ(errorTailBound(Mat3::Identity(), 0.0), 1.0);
  EXPECT_EQ(errorTailBound(Mat3::Identity(), -1.0), 1.0);
  EXPECT_EQ(errorTailBound(Mat3::Zero(), 0.0), 1.0);
  EXPECT_EQ(errorTailBound(Mat3::Zero(), 1e-9), 0.0);
  EXPECT_EQ(errorTailBound(Mat3::Identity(), 38.0), 0.0);
  EXPECT_GT(errorTailBound(Mat3::Identity(), 37.0), 0.0);
  EXPECT_EQ(errorTailBound(Mat3::Identity(), std::numeric_limits<double>::infinity()), 0.0);
}

TEST(ErrorTailBound, WhatIsNotACovarianceIsNeverSafe) {
  EXPECT_EQ(errorTailBound(diagonal(1e-4, 1e-4, -1e-4), 5.0), 1.0);
  EXPECT_EQ(errorTailBound(-Mat3::Identity(), 5.0), 1.0);
  EXPECT_EQ(errorTailBound(diagonal(1e-4, kNan, 1e-4), 5.0), 1.0);
  EXPECT_EQ(errorTailBound(diagonal(std::numeric_limits<double>::infinity(), 0.0, 0.0), 5.0), 1.0);
  EXPECT_EQ(errorTailBound(Mat3::Constant(std::numeric_limits<double>::max()), 5.0), 1.0);
  EXPECT_EQ(errorTailBound(Mat3::Identity(), kNan), 1.0);
  Mat3 correlated_beyond_one = 1e-4 * Mat3::Identity();
  correlated_beyond_one(0, 1) = correlated_beyond_one(1, 0) = 2e-4;
  EXPECT_EQ(errorTailBound(correlated_beyond_one, 5.0), 1.0);
}

TEST(ErrorTailBound, RoundingInTheCovarianceIsForgiven) {
  const double clean = errorTailBound(diagonal(0.09, 0.09, 0.0), 1.0);
  EXPECT_NEAR(errorTailBound(diagonal(0.09, 0.09, -1e-17), 1.0) / clean, 1.0, 1e-6);
  Mat3 skewed = diagonal(0.09, 0.09, 0.0);
  skewed(0, 1) = 1e-16;
  EXPECT_NEAR(errorTailBound(skewed, 1.0) / clean, 1.0, 1e-6);
}

TEST(ErrorTailBound, ReadsBothHalvesOfAnAsymmetricMatrix) {
  Mat3 upper = 0.09 * Mat3::Identity();
  upper(0, 1) = 0.08;
  const Mat3 both = 0.5 * (upper + upper.transpose());
  EXPECT_EQ(errorTailBound(upper, 1.0), errorTailBound(both, 1.0));
  EXPECT_EQ(errorTailBound(upper.transpose(), 1.0), errorTailBound(both, 1.0));
}

/// Equal eigenvalues and a vanishing one have their own branches: no step where they begin.
TEST(ErrorTailBound, IsContinuousAcrossTheLimits) {
  for (const double radius_m : {0.2, 1.0, 3.0, 6.0}) {
    const auto tail = [&](double l1, double l2, double l3) { return errorTailBound(diagonal(l1, l2, l3), radius_m); };
    for (double difference = 1e-18; difference < 1e-6; difference *= 2.0) {
      const double smooth = 1e-5 + 40.0 * difference;
      EXPECT_NEAR(tail(1.0, 1.0, 1.0 - difference) / tail(1.0, 1.0, 1.0), 1.0, smooth);
      EXPECT_NEAR(tail(1.0, 1.0 - difference, 0.3) / tail(1.0, 1.0, 0.3), 1.0, smooth);
      EXPECT_NEAR(tail(1.0, 0.3, difference) / tail(1.0, 0.3, 0.0), 1.0, smooth);
      EXPECT_NEAR(tail(1.0, difference, 0.0) / tail(1.0, 0.0, 0.0), 1.0, 1e-3);
    }
  }
  for (const double scale_m : {1e-150, 1e-9, 1.0, 1e9, 1e150}) {
    EXPECT_NEAR(errorTailBound(scale_m * scale_m * diagonal(1.0, 1.0, 0.25), 3.0 * scale_m),
                errorTailBound(diagonal(1.0, 1.0, 0.25), 3.0), 1e-8);
  }
}

constexpr double kMonotoneSlack = 1e-5;  ///< relative: the eigenvalues' rounding, 1e-7 of R^2 / 2 l1

rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::inRange(0, 1'000'001),
                      [=](int millionths) { return low + (high - low) * 1e-6 * millionths; });
}

Mat3 anyCovariance() {
  const Vec3 deviations_m(*between(0.0, 1.0), *between(0.0, 1.0), *between(0.0, 1.0));
  const Quat rotation(*between(0.1, 1.0), *between(-1.0, 1.0), *between(-1.0, 1.0), *between(-1.0, 1.0));
  return rotated(deviations_m.array().square(), rotation.normalized());
}

RC_GTEST_PROP(ErrorTailBoundProperty, FallsWithTheRadius, ()) {
  const Mat3 covariance_m2 = anyCovariance();
  const double radius_m = *between(0.0, 5.0);
  const double further_m = radius_m + *between(0.0, 1.0);
  RC_ASSERT(errorTailBound(covariance_m2, further_m) <= errorTailBound(covariance_m2, radius_m));
}

RC_GTEST_PROP(ErrorTailBoundProperty, RisesWithTheCovariance, ()) {
  const Mat3 covariance_m2 = anyCovariance();
  const Vec3 more_m(*between(-1.0, 1.0), *between(-1.0, 1.0), *between(-1.0, 1.0));
  const double radius_m = *between(0.0, 5.0);
  const double before = errorTailBound(covariance_m2, radius_m);
  const double after = errorTailBound(covariance_m2 + more_m * more_m.transpose(), radius_m);
  RC_ASSERT(before <= after * (1.0 + kMonotoneSlack));
}

}  // namespace
}  // namespace nanomap
