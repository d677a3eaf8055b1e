#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "core/raw_range.h"
#include "core/ray_tiles.h"
#include "core/tile_tangents.h"

namespace nanomap {

/// Brown-Conrady coefficients in OpenCV's order and sign; all zero means a plain pinhole.
struct Distortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  [[nodiscard]] bool isZero() const { return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0; }
  bool operator==(const Distortion&) const = default;
};

/// What a depth camera is. Pixel centres lie at integer coordinates: pixel (u, v) covers u-0.5 .. u+0.5.
struct CameraParameters {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  Distortion distortion;
  Pose T_B_C;                                                ///< camera (RDF) in body (FLU), lever arm included
  double depth_unit_m = 0.001;                               ///< metres per count
  double min_range_m = 0.0;                                  ///< nearest trusted depth along the optical axis
  double max_range_m = 0.0;                                  ///< farthest trusted depth along the optical axis
  std::vector<std::uint16_t> no_return_values = {0, 65535};  ///< raw values that mean "no depth"

  bool operator==(const CameraParameters&) const = default;
};

/// What a raw depth value says about its ray.
enum class DepthReading : std::uint8_t {
  kNone,     ///< the sensor gave no depth
  kTooNear,  ///< a return nearer than the trusted range: something is there, where is not known
  kInRange,
  kTooFar,  ///< a return beyond the trusted range: the ray is free up to the range limit
};

/// The view frustum in camera frame C (RDF): tangents x/z and y/z of its side planes, depths of its near and far
/// planes.
struct Frustum {
  double tan_left = 0.0;
  double tan_right = 0.0;
  double tan_top = 0.0;
  double tan_bottom = 0.0;
  double near_m = 0.0;
  double far_m = 0.0;
};

/// Pinhole camera with optional Brown-Conrady distortion. Distortion is undone once, here, into lookups: neither
/// deprojection nor projection evaluates or inverts the polynomial afterwards.
/// With distortion the frustum is the largest upright rectangle of tangents inside the curved image border, so that
/// whatever is in the frustum has a pixel.
/// Threads: immutable, any number of readers.
class CameraModel {
 public:
  /// @throws std::invalid_argument naming the parameter and its value: sizes and focal lengths must be positive, the
  ///         range must be 0 <= min < max, the depth unit positive, the extrinsic rotation a unit quaternion, and the
  ///         distortion invertible over the whole image.
  explicit CameraModel(CameraParameters parameters);

  [[nodiscard]] const CameraParameters& parameters() const { return parameters_; }
  [[nodiscard]] const Frustum& frustum() const { return frustum_; }
  [[nodiscard]] int width() const { return parameters_.width_px; }
  [[nodiscard]] int height() const { return parameters_.height_px; }
  [[nodiscard]] std::size_t pixelCount() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }

  [[nodiscard]] DepthReading classify(std::uint16_t raw) const {
    for (const std::uint16_t value : parameters_.no_return_values) {
      if (raw == value) return DepthReading::kNone;
    }
    const double depth_m = static_cast<double>(depth(raw));
    if (depth_m < parameters_.min_range_m) return DepthReading::kTooNear;
    if (depth_m > parameters_.max_range_m) return DepthReading::kTooFar;
    return DepthReading::kInRange;
  }

  /// The raw values that classify() finds to be in range.
  [[nodiscard]] const RawRange& inRange() const { return in_range_; }

  /// Metres per count, as depth() has it.
  [[nodiscard]] float depthUnit_m() const { return depth_unit_m_; }

  /// Depth along the optical axis [m] of a raw value that is a return.
  [[nodiscard]] float depth(std::uint16_t raw) const { return static_cast<float>(raw) * depth_unit_m_; }

  /// Point in C [m] seen by the pixel with row-major index `pixel` at raw depth `raw` (a return).
  [[nodiscard]] Vec3f deproject(std::size_t pixel, std::uint16_t raw) const {
    const float z_m = depth(raw);
    return {ray_tangents_[pixel].x() * z_m, ray_tangents_[pixel].y() * z_m, z_m};
  }

  /// Tangents x/z and y/z in C of the ray through the pixel with row-major index `pixel`.
  [[nodiscard]] const Eigen::Vector2f& rayTangents(std::size_t pixel) const { return ray_tangents_[pixel]; }

  /// The tangents of all rays once more, in the order of the nearest-point index.
  [[nodiscard]] const RayTiles& rayTiles() const { return ray_tiles_; }

  /// Their bounds along columns and rows of tiles.
  [[nodiscard]] const TileTangents& tileTangents() const { return tile_tangents_; }

  struct Pixel {
    int u = 0;
    int v = 0;
  };

  /// The frustum's cross-section is cut into as many equal cells as the image has pixels: without distortion they are
  /// the pixels. This is the pixel that sees the middle of a cell, given by column and row.
  [[nodiscard]] Pixel pixelOfCell(Pixel cell) const {
    if (distorted_pixel_.empty()) return cell;
    const int pixel = distorted_pixel_[static_cast<std::size_t>(cell.v) * static_cast<std::size_t>(width()) +
                                       static_cast<std::size_t>(cell.u)];
    return {pixel % width(), pixel / width()};
  }

  /// The pixel whose ray is nearest to the tangents (x/z, y/z); empty outside the frustum's sides.
  [[nodiscard]] std::optional<Pixel> pixelAt(double tan_x, double tan_y) const {
    const bool inside = tan_x >= frustum_.tan_left && tan_x <= frustum_.tan_right && tan_y >= frustum_.tan_top &&
                        tan_y <= frustum_.tan_bottom;
    if (!inside) return std::nullopt;
    const auto cell = [](double share, int count) { return std::min(static_cast<int>(share * count), count - 1); };
    const int u = cell((tan_x - frustum_.tan_left) / (frustum_.tan_right - frustum_.tan_left), width());
    const int v = cell((tan_y - frustum_.tan_top) / (frustum_.tan_bottom - frustum_.tan_top), height());
    return pixelOfCell({u, v});
  }

 private:
  void undistortOnce();
  void findRawRange();

  CameraParameters parameters_;
  float depth_unit_m_;
  Frustum frustum_;
  std::vector<Eigen::Vector2f> ray_tangents_;  ///< row-major, one a pixel
  RayTiles ray_tiles_;
  TileTangents tile_tangents_;
  RawRange in_range_;
  std::vector<std::int32_t> distorted_pixel_;  ///< cell -> image pixel; empty without distortion
};

}  // namespace nanomap
