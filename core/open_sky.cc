#include "core/open_sky.h"

#include <algorithm>

namespace nanomap {
namespace {

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

}  // namespace nanomap
