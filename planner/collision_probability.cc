#include "planner/collision_probability.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace nanomap {
namespace {

/// Eigen's closed form for 3x3 is good to the square root of epsilon (1.5e-8 of the largest) where two eigenvalues are
/// nearly equal, which is the usual case here. Smaller differences and smaller negative values are rounding.
constexpr double kEigenvalueSlack = 1e-7;

/// exp, erf and erfc are good to a few epsilons times their exponent, which is below kCertainExponent.
constexpr double kResultSlack = 1e-12;

/// exp(-700) = 1e-304: the tail is below 1e-300 and its terms stay clear of underflow and overflow.
constexpr double kCertainExponent = 700.0;

/// The index compares distances in float, after rounding the mean to float: of two points it may prefer the farther by
/// 1 epsilon of the mean's distance from the origin (both roundings) and 2.5 of the distance itself.
constexpr double kIndexRounding = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

/// Squared cosine of 0, 22.5, 45 and 67.5 degrees: where the four arcs of a quadrant have their largest variance.
constexpr std::array<double, 4> kArcCosineSquared = {1.0, (2.0 + std::numbers::sqrt2) / 4.0, 0.5,
                                                     (2.0 - std::numbers::sqrt2) / 4.0};

constexpr double square(double value) { return value * value; }

Mat3 symmetric(const Mat3& matrix) { return 0.5 * (matrix + matrix.transpose()); }

/// What is not a number, or is not a probability any more, is not known to be safe.
double probability(double value) { return value < 1.0 ? std::max(value, 0.0) : 1.0; }

/// P(|z| <= R / sqrt(l3) and the error is longer than R), with z the standardised third coordinate, if the other two
/// coordinates have the variance `planar_m2` each. Increases with it.
///   = integral of phi(z) exp(-(R^2 - l3 z^2) / (2 s)) over |z| <= R / sqrt(l3)
///   = exp(-R^2 / 2 s) erf(sqrt(c a / 2)) / sqrt(a)   with a = 1 - l3 / s, c = R^2 / l3
double insideTerm(double radius_sq_m2, double planar_m2, double third_m2) {
  const double flatness = std::max(0.0, (planar_m2 - third_m2) / planar_m2);
  const double reach_sq = radius_sq_m2 / third_m2;
  const double weight = flatness > 0.0 ? std::erf(std::sqrt(0.5 * reach_sq * flatness)) / std::sqrt(flatness)
                                       : std::sqrt(2.0 * reach_sq / std::numbers::pi);
  return std::exp(-0.5 * radius_sq_m2 / planar_m2) * weight;
}

double ball(const UncertainPoint& x_C, std::span<const Neighbour> neighbours, double vehicle_radius_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Neighbour& neighbour : neighbours) {
    nearest_m = std::min(nearest_m, (neighbour.point_C.cast<double>() - x_C.mean_m).norm());
  }
  nearest_m -= kIndexRounding * (x_C.mean_m.norm() + nearest_m);
  return errorTailBound(x_C.covariance_m2, nearest_m - vehicle_radius_m);
}

double gaussianVolume(const UncertainPoint& x_C, const Neighbour& nearest, const CollisionParameters& parameters) {
  const Mat3 covariance_m2 = symmetric(x_C.covariance_m2) + parameters.measured_point_variance_m2 * Mat3::Identity();
  const Eigen::LLT<Mat3> root(covariance_m2);
  if (root.info() != Eigen::Success) return 1.0;

  Vec3 offset_m = nearest.point_C.cast<double>() - x_C.mean_m;
  const double distance_m = offset_m.norm();
  offset_m *= distance_m > parameters.pull_to_vehicle_m ? 1.0 - parameters.pull_to_vehicle_m / distance_m : 0.0;

  const double volume_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(parameters.vehicle_radius_m, 3);
  const double mahalanobis_sq = root.matrixL().solve(offset_m).squaredNorm();
  const double root_determinant_m3 = root.matrixLLT().diagonal().prod();
  return probability(volume_m3 * std::exp(-0.5 * mahalanobis_sq) /
                     (std::pow(2.0 * std::numbers::pi, 1.5) * root_determinant_m3));
}

double halfSpaces(const UncertainPoint& x_C, std::span<const Neighbour> neighbours, double vehicle_radius_m) {
  const Mat3 covariance_m2 = symmetric(x_C.covariance_m2);
  const double rounding_m2 = kEigenvalueSlack * covariance_m2.diagonal().cwiseAbs().maxCoeff();
  double sum = 0.0;
  for (const Neighbour& neighbour : neighbours) {
    const Vec3 offset_m = neighbour.point_C.cast<double>() - x_C.mean_m;
    const double distance_m = offset_m.norm();
    const double gap_m = distance_m - vehicle_radius_m;
    if (gap_m <= 0.0) return 1.0;
    const Vec3 direction = offset_m / distance_m;
    const double variance_m2 = direction.dot(covariance_m2 * direction);
    if (variance_m2 < -rounding_m2) return 1.0;
    if (variance_m2 > 0.0) sum += 0.5 * std::erfc(gap_m / std::sqrt(2.0 * variance_m2));
  }
  return probability(sum);
}

bool allFinite(const UncertainPoint& x_C, std::span<const Neighbour> neighbours,
               const CollisionParameters& parameters) {
  return x_C.mean_m.allFinite() && x_C.covariance_m2.allFinite() && std::isfinite(parameters.vehicle_radius_m) &&
         std::isfinite(parameters.pull_to_vehicle_m) && std::isfinite(parameters.measured_point_variance_m2) &&
         std::all_of(neighbours.begin(), neighbours.end(), [](const Neighbour& neighbour) {
           return neighbour.point_C.allFinite() && std::isfinite(neighbour.distance_m);
         });
}

}  // namespace

double errorTailBound(const Mat3& covariance_m2, double radius_m) {
  if (!(radius_m > 0.0) || !covariance_m2.allFinite()) return 1.0;
  if (covariance_m2.isZero(0.0)) return 0.0;

  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(symmetric(covariance_m2), Eigen::EigenvaluesOnly);
  const Vec3& ascending_m2 = solver.eigenvalues();
  const double slack_m2 = kEigenvalueSlack * ascending_m2.cwiseAbs().maxCoeff();
  if (!(ascending_m2[0] >= -slack_m2)) return 1.0;
  const double first_m2 = ascending_m2[2] + slack_m2;
  const double second_m2 = std::max(ascending_m2[1], 0.0) + slack_m2;
  const double third_m2 = std::max(ascending_m2[0], 0.0) + slack_m2;

  const double radius_sq_m2 = square(radius_m);
  if (radius_sq_m2 > 2.0 * kCertainExponent * first_m2) return 0.0;

  double inside = insideTerm(radius_sq_m2, first_m2, third_m2);
  if (first_m2 - second_m2 > slack_m2) {
    for (std::size_t i = 1; i < kArcCosineSquared.size(); ++i) {
      const double planar_m2 = second_m2 + kArcCosineSquared[i] * (first_m2 - second_m2);
      inside += insideTerm(radius_sq_m2, planar_m2, third_m2);
    }
    inside /= static_cast<double>(kArcCosineSquared.size());
  }
  const double outside = std::erfc(std::sqrt(0.5 * radius_sq_m2 / third_m2));
  return probability((outside + inside) * (1.0 + kResultSlack));
}

double reachThatMatters_m(double largest_variance_m2, const CollisionParameters& parameters) {
  if (parameters.model == CollisionModel::kGaussianVolume) return std::numeric_limits<double>::infinity();
  // P(|e| > 6.7 sigma) is 9.8e-10 for an error that is the same in all directions, and less for any other.
  constexpr double kSigmas = 6.7;
  return parameters.vehicle_radius_m + kSigmas * std::sqrt(largest_variance_m2);
}

double collisionProbability(const UncertainPoint& x_C, std::span<const Neighbour> neighbours,
                            const CollisionParameters& parameters) {
  if (!allFinite(x_C, neighbours, parameters)) return 1.0;
  if (neighbours.empty()) return 0.0;
  switch (parameters.model) {
    case CollisionModel::kBall:
      return ball(x_C, neighbours, parameters.vehicle_radius_m);
    case CollisionModel::kGaussianVolume:
      return gaussianVolume(x_C, neighbours.front(), parameters);
    case CollisionModel::kHalfSpaces:
      return halfSpaces(x_C, neighbours, parameters.vehicle_radius_m);
  }
  return 1.0;
}

}  // namespace nanomap
