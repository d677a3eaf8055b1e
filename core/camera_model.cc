#include "core/camera_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace nanomap {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("camera: " + message);
}

void checkPositive(double value, const char* name) {
  require(std::isfinite(value) && value > 0.0, std::string(name) + " must be positive, not " + std::to_string(value));
}

void check(const CameraParameters& camera) {
  require(camera.width_px > 0 && camera.height_px > 0, "width and height must be positive, not " +
                                                           std::to_string(camera.width_px) + " x " +
                                                           std::to_string(camera.height_px));
  checkPositive(camera.fx_px, "fx");
  checkPositive(camera.fy_px, "fy");
  require(std::isfinite(camera.cx_px) && std::isfinite(camera.cy_px), "cx and cy must be finite");
  checkPositive(camera.depth_unit_m, "depth_unit_m");
  require(std::isfinite(camera.min_range_m) && camera.min_range_m >= 0.0,
          "min_range_m must be zero or more, not " + std::to_string(camera.min_range_m));
  require(std::isfinite(camera.max_range_m) && camera.max_range_m > camera.min_range_m,
          "max_range_m must be above min_range_m, not " + std::to_string(camera.max_range_m));
  require(camera.T_B_C.translation_m.allFinite() && camera.T_B_C.rotation.coeffs().allFinite() &&
              std::abs(camera.T_B_C.rotation.norm() - 1.0) <= kUnitNormTolerance,
          "the extrinsic pose must be finite, with a unit quaternion");
}

/// Brown-Conrady: undistorted tangents to distorted ones, with the Jacobian.
struct Distorted {
  Vec2 tangents;
  Mat2 jacobian;
};

Distorted distort(const Distortion& d, const Vec2& t) {
  const double x = t.x();
  const double y = t.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double radial_slope = 2.0 * (d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3));  // d(radial)/dx = slope * x
  Distorted out;
  out.tangents = {x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
                  y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y};
  const double cross = radial_slope * x * y + 2.0 * d.p1 * x + 2.0 * d.p2 * y;
  out.jacobian << radial + radial_slope * x * x + 2.0 * d.p1 * y + 6.0 * d.p2 * x, cross,  //
      cross, radial + radial_slope * y * y + 6.0 * d.p1 * y + 2.0 * d.p2 * x;
  return out;
}

/// Inverts distort() by Newton's method. Refuses a point where the distortion folds over.
Vec2 undistort(const Distortion& distortion, const Vec2& target) {
  constexpr int kMaxIterations = 50;
  constexpr double kConverged = 1e-12;
  Vec2 t = target;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Distorted at = distort(distortion, t);
    const double determinant = at.jacobian.determinant();
    if (!(determinant > 0.0)) break;
    const Vec2 step = at.jacobian.inverse() * (target - at.tangents);
    t += step;
    if (step.squaredNorm() < kConverged * kConverged) return t;
  }
  throw std::invalid_argument("camera: the distortion cannot be inverted over the whole image (at tangents " +
                              std::to_string(target.x()) + ", " + std::to_string(target.y()) + ")");
}

}  // namespace

CameraModel::CameraModel(CameraParameters parameters)
    : parameters_(std::move(parameters)), depth_unit_m_(static_cast<float>(parameters_.depth_unit_m)) {
  check(parameters_);
  parameters_.T_B_C.rotation.normalize();
  const CameraParameters& c = parameters_;
  frustum_ = {.tan_left = (-0.5 - c.cx_px) / c.fx_px,
              .tan_right = (c.width_px - 0.5 - c.cx_px) / c.fx_px,
              .tan_top = (-0.5 - c.cy_px) / c.fy_px,
              .tan_bottom = (c.height_px - 0.5 - c.cy_px) / c.fy_px,
              .near_m = c.min_range_m,
              .far_m = c.max_range_m};
  ray_tangents_.reserve(pixelCount());
  if (c.distortion.isZero()) {
    for (int v = 0; v < height(); ++v) {
      for (int u = 0; u < width(); ++u) {
        ray_tangents_.emplace_back(static_cast<float>((u - c.cx_px) / c.fx_px),
                                   static_cast<float>((v - c.cy_px) / c.fy_px));
      }
    }
  } else {
    undistortOnce();
  }
  ray_tiles_ = RayTiles({width(), height()}, ray_tangents_);
  tile_tangents_ = TileTangents({width(), height()}, ray_tangents_);
  findRawRange();
}

void CameraModel::findRawRange() {
  constexpr int kGreatestRaw = std::numeric_limits<std::uint16_t>::max();
  const auto inRange = [this](int raw) { return classify(static_cast<std::uint16_t>(raw)) == DepthReading::kInRange; };
  int least = 0;
  while (least <= kGreatestRaw && !inRange(least)) ++least;
  if (least > kGreatestRaw) return;  // none
  int greatest = kGreatestRaw;
  while (!inRange(greatest)) --greatest;
  in_range_ = {static_cast<std::uint16_t>(least), static_cast<std::uint16_t>(greatest), {}};
  for (const std::uint16_t value : parameters_.no_return_values) {
    if (value > least && value < greatest) in_range_.excluded.push_back(value);
  }
}

void CameraModel::undistortOnce() {
  const CameraParameters& c = parameters_;
  const auto tangentsAt = [&c](double u, double v) {
    return undistort(c.distortion, {(u - c.cx_px) / c.fx_px, (v - c.cy_px) / c.fy_px});
  };
  for (int v = 0; v < height(); ++v) {
    for (int u = 0; u < width(); ++u) ray_tangents_.push_back(tangentsAt(u, v).cast<float>());
  }

  frustum_.tan_left = frustum_.tan_top = -std::numeric_limits<double>::infinity();
  frustum_.tan_right = frustum_.tan_bottom = std::numeric_limits<double>::infinity();
  for (int v = 0; v <= height(); ++v) {
    frustum_.tan_left = std::max(frustum_.tan_left, tangentsAt(-0.5, v - 0.5).x());
    frustum_.tan_right = std::min(frustum_.tan_right, tangentsAt(width() - 0.5, v - 0.5).x());
  }
  for (int u = 0; u <= width(); ++u) {
    frustum_.tan_top = std::max(frustum_.tan_top, tangentsAt(u - 0.5, -0.5).y());
    frustum_.tan_bottom = std::min(frustum_.tan_bottom, tangentsAt(u - 0.5, height() - 0.5).y());
  }
  if (!(frustum_.tan_left < frustum_.tan_right && frustum_.tan_top < frustum_.tan_bottom)) {
    throw std::invalid_argument("camera: the distortion leaves no field of view");
  }

  // The frustum, cut into as many cells as the image has pixels, each with the pixel its centre is seen by.
  distorted_pixel_.reserve(pixelCount());
  for (int v = 0; v < height(); ++v) {
    const double tan_y = frustum_.tan_top + (v + 0.5) / height() * (frustum_.tan_bottom - frustum_.tan_top);
    for (int u = 0; u < width(); ++u) {
      const double tan_x = frustum_.tan_left + (u + 0.5) / width() * (frustum_.tan_right - frustum_.tan_left);
      const Vec2 at = distort(c.distortion, {tan_x, tan_y}).tangents;
      const auto column = std::clamp<long>(std::lround(at.x() * c.fx_px + c.cx_px), 0, width() - 1);
      const auto row = std::clamp<long>(std::lround(at.y() * c.fy_px + c.cy_px), 0, height() - 1);
      distorted_pixel_.push_back(static_cast<std::int32_t>(row * width() + column));
    }
  }
}

}  // namespace nanomap
