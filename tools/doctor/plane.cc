#include "tools/doctor/plane.h"

#include <Eigen/Eigenvalues>
#include <cstddef>
#include <random>

namespace nanomap::doctor {
namespace {

constexpr int kTrials = 1000;  // three points of a plane that a fifth of all lie on: eight times
constexpr int kFits = 3;
constexpr double kThin = 1e-3;  ///< sine of the least angle of a triangle that tells a plane

/// How far from its plane a point may be measured: noise, and what grows with range.
double tolerance_m(const Vec3& point) {
  constexpr double kNear_m = 0.03;
  constexpr double kPerRange = 0.015;
  return kNear_m + kPerRange * point.norm();
}

/// Turned towards the origin.
Plane facing(const Vec3& normal, const Vec3& on_it) {
  const double along_m = normal.dot(on_it);
  return along_m > 0.0 ? Plane{.normal = -normal, .distance_m = along_m}
                       : Plane{.normal = normal, .distance_m = -along_m};
}

/// Above 0 on the origin's side.
double height_m(const Plane& plane, const Vec3& point) { return plane.normal.dot(point) + plane.distance_m; }

bool liesOn(const Plane& plane, const Vec3& point) { return std::abs(height_m(plane, point)) <= tolerance_m(point); }

void count(Plane& plane, const std::vector<Vec3>& points) {
  constexpr double kClearly = 3.0;
  double on_it = 0.0;
  double behind = 0.0;
  for (const Vec3& point : points) {
    if (liesOn(plane, point)) ++on_it;
    if (height_m(plane, point) < -kClearly * tolerance_m(point)) ++behind;
  }
  plane.share = on_it / static_cast<double>(points.size());
  plane.share_behind = behind / static_cast<double>(points.size());
}

/// Least squares over the points on it, each by how well it is known.
Plane fitted(const Plane& plane, const std::vector<Vec3>& points) {
  double weights = 0.0;
  Vec3 mean = Vec3::Zero();
  Mat3 moments = Mat3::Zero();
  for (const Vec3& point : points) {
    if (!liesOn(plane, point)) continue;
    const double weight = 1.0 / (tolerance_m(point) * tolerance_m(point));
    weights += weight;
    mean += weight * point;
    moments += weight * point * point.transpose();
  }
  if (weights == 0.0) return plane;
  mean /= weights;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments / weights - mean * mean.transpose());
  return facing(axes.eigenvectors().col(0), mean);  // ascending: the thinnest
}

}  // namespace

std::optional<Plane> largestPlane(const std::vector<Vec3>& points,
                                  const std::function<bool(const Vec3& normal)>& eligible) {
  constexpr std::size_t kCorners = 3;
  if (points.size() < kCorners) return std::nullopt;
  std::mt19937 random;  // its own first seed: the same each time
  const auto any = [&]() -> const Vec3& { return points[random() % points.size()]; };
  std::optional<Plane> largest;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vec3& corner = any();
    const Vec3 first = any() - corner;
    const Vec3 second = any() - corner;
    const Vec3 normal = first.cross(second);
    if (normal.norm() <= kThin * first.norm() * second.norm()) continue;
    Plane plane = facing(normal.normalized(), corner);
    if (!eligible(plane.normal)) continue;
    count(plane, points);
    if (!largest || plane.share > largest->share) largest = plane;
  }
  if (!largest) return std::nullopt;
  for (int fit = 0; fit < kFits; ++fit) {
    Plane better = fitted(*largest, points);
    count(better, points);
    if (!eligible(better.normal) || better.share < largest->share) break;
    largest = better;
  }
  return largest;
}

}  // namespace nanomap::doctor
