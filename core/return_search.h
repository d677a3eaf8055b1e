#pragma once

#include "core/camera_model.h"
#include "core/geometry.h"
#include "core/view.h"

namespace nanomap {

/// Columns and rows of an image, ends included.
struct PixelRect {
  int u_min, u_max, v_min, v_max;

  [[nodiscard]] static PixelRect of(CameraModel::Pixel pixel) { return {pixel.u, pixel.u, pixel.v, pixel.v}; }

  bool operator==(const PixelRect&) const = default;
};

/// A line through an image, given by a pixel on it and the direction that is up. Without a direction there is no
/// level: everything is as high as the line.
struct ImageLevel {
  CameraModel::Pixel through;
  Eigen::Vector2d up = Eigen::Vector2d::Zero();

  /// Level with the pixel within half a pixel, or higher?
  [[nodiscard]] bool isReachedBy(CameraModel::Pixel at) const {
    constexpr double kLevel_px = 0.5;
    const double height_px = (at.u - through.u) * up.x() + (at.v - through.v) * up.y();
    return height_px >= -kLevel_px;
  }
};

/// Does a pixel of `rect`, level with `level` or above, carry a depth of at most `limit_m` (too near ones included)?
/// Answered from the view's tiles, and from pixels only where a tile leaves it open.
/// @pre `rect` lies inside the image
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] bool hasReturnWithin(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level);

}  // namespace nanomap
