#include "core/open_sky.h"

#include <algorithm>
#include <cmath>

namespace nanomap {
namespace {

/// A glance looks at a row of tiles so many above a pixel's, and so many to both sides.
constexpr int kGlance_tiles = 3;
/// From a pixel to the nearest row of those tiles at least, and to what is farthest of them at most.
constexpr int kGlanceBegin_px = (kGlance_tiles - 1) * DepthTiles::kEdge_px + 1;
constexpr int kGlanceEnd_px = (kGlance_tiles + 1) * DepthTiles::kEdge_px - 1;

/// `rect`, and the pixels up to `reach_u` and `reach_v` beside and above it, as far as there are any.
PixelRect windowAround(const CameraModel& camera, const PixelRect& rect, double reach_u, double reach_v) {
  const auto u = static_cast<int>(std::min(reach_u, static_cast<double>(camera.width())));
  const auto v = static_cast<int>(std::min(reach_v, static_cast<double>(camera.height())));
  return {std::max(rect.u_min - u, 0), std::min(rect.u_max + u, camera.width() - 1),  //
          std::max(rect.v_min - v, 0), std::min(rect.v_max + v, camera.height() - 1)};
}

/// Through the lowest of its corners.
ImageLevel levelOf(const PixelRect& rect, const Vec3& up_C) {
  // Looking straight up or down, the image has no level: then whatever is near speaks against sky.
  constexpr double kLeastUpInImage = 1e-3;
  ImageLevel level{.through = {rect.u_min, rect.v_min}};
  const Eigen::Vector2d up_image = up_C.head<2>();
  if (up_image.norm() < kLeastUpInImage) return level;
  level.up = up_image.normalized();
  if (level.up.x() < 0.0) level.through.u = rect.u_max;
  if (level.up.y() < 0.0) level.through.v = rect.v_max;
  return level;
}

}  // namespace

bool isOpen(const View& view, const PixelRect& gap, double z_m, const Vec3& up_C, const QueryOptions& options) {
  const CameraModel& camera = view.camera();
  const PixelRect window = windowAround(camera, gap, options.open_window_px, options.open_window_px);
  const double far_m = options.open_range_fraction * camera.frustum().far_m;
  const ImageLevel level = levelOf(gap, up_C);
  if (hasReturnWithin(view, window, far_m, level)) return false;
  const PixelRect frame = windowAround(camera, gap, camera.parameters().fx_px * options.open_frame_m / z_m,
                                       camera.parameters().fy_px * options.open_frame_m / z_m);
  return !hasReturnWithin(view, frame, std::min(z_m + options.open_frame_m, far_m), level);
}

bool isHoleAtGlance(const View& view, CameraModel::Pixel pixel, const QueryOptions& options) {
  const int column = pixel.u / DepthTiles::kEdge_px;
  const int row = pixel.v / DepthTiles::kEdge_px - kGlance_tiles;
  if (row < 0 || options.open_window_px < kGlanceEnd_px) return false;
  const DepthTiles& tiles = view.tiles();
  const std::uint16_t* of_row = tiles.least().data() + tiles.tileAt(0, row);
  const std::uint16_t least = *std::min_element(of_row + std::max(column - kGlance_tiles, 0),
                                                of_row + std::min(column + kGlance_tiles + 1, tiles.columns()));
  const double far_m = options.open_range_fraction * view.camera().frustum().far_m;
  return least != DepthTiles::kNoDepth && static_cast<double>(view.camera().depth(least)) <= far_m;
}

bool liesBelowGlance(const Vec3& up_C) { return kGlanceBegin_px * -up_C.y() >= kGlanceEnd_px * std::abs(up_C.x()); }

}  // namespace nanomap
