#include "tools/simulation/solid.h"

#include <algorithm>
#include <cmath>

namespace nanomap::simulation {
namespace {

struct DistanceTo {
  const Vec3& p_W;

  double operator()(const UprightBox& box) const {
    const Vec3 p_box = Eigen::AngleAxisd(-box.yaw_rad, Vec3::UnitZ()) * (p_W - box.center_W);
    const Vec3 beyond_m = p_box.cwiseAbs() - box.half_size_m;
    return beyond_m.cwiseMax(0.0).norm() + std::min(beyond_m.maxCoeff(), 0.0);
  }

  double operator()(const Cylinder& cylinder) const {
    const Vec3 axis_m = cylinder.top_W - cylinder.base_W;
    const double length_m = axis_m.norm();
    const Vec3 from_base_m = p_W - cylinder.base_W;
    const double along_m = from_base_m.dot(axis_m) / length_m;
    const double beside_m = (from_base_m - along_m / length_m * axis_m).norm() - cylinder.radius_m;
    const double past_end_m = std::abs(along_m - length_m / 2.0) - length_m / 2.0;
    return std::hypot(std::max(beside_m, 0.0), std::max(past_end_m, 0.0)) +
           std::min(std::max(beside_m, past_end_m), 0.0);
  }

  double operator()(const Sphere& sphere) const { return (p_W - sphere.center_W).norm() - sphere.radius_m; }
};

struct BoundsOf {
  Box3 operator()(const UprightBox& box) const {
    const double c = std::abs(std::cos(box.yaw_rad));
    const double s = std::abs(std::sin(box.yaw_rad));
    const Vec3 half_m(c * box.half_size_m.x() + s * box.half_size_m.y(),
                      s * box.half_size_m.x() + c * box.half_size_m.y(), box.half_size_m.z());
    return {box.center_W - half_m, box.center_W + half_m};
  }

  Box3 operator()(const Cylinder& cylinder) const {
    // The end discs reach radius * sin(angle to the axis) along each world axis.
    const Vec3 axis = (cylinder.top_W - cylinder.base_W).normalized();
    const Vec3 reach_m = cylinder.radius_m * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    Box3 box(cylinder.base_W.cwiseMin(cylinder.top_W), cylinder.base_W.cwiseMax(cylinder.top_W));
    box.min() -= reach_m;
    box.max() += reach_m;
    return box;
  }

  Box3 operator()(const Sphere& sphere) const {
    const Vec3 reach_m = Vec3::Constant(sphere.radius_m);
    return {sphere.center_W - reach_m, sphere.center_W + reach_m};
  }
};

}  // namespace

double signedDistance(const Solid& solid, const Vec3& p_W) { return std::visit(DistanceTo{p_W}, solid); }

Box3 bounds(const Solid& solid) { return std::visit(BoundsOf{}, solid); }

}  // namespace nanomap::simulation
