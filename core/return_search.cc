#include "core/return_search.h"

#include <algorithm>
#include <cstdint>

namespace nanomap {
namespace {

bool isWithin(const CameraModel& camera, std::uint16_t raw, double limit_m) {
  return static_cast<double>(camera.depth(raw)) <= limit_m;
}

bool scanPixels(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level) {
  const CameraModel& camera = view.camera();
  for (int v = rect.v_min; v <= rect.v_max; ++v) {
    for (int u = rect.u_min; u <= rect.u_max; ++u) {
      const std::uint16_t raw = view.rawAt(u, v);
      if (!isWithin(camera, raw, limit_m) || camera.classify(raw) == DepthReading::kNone) continue;
      if (level.isReachedBy({u, v})) return true;
    }
  }
  return false;
}

enum class Part { kNone, kSome, kAll };

/// How much of `rect` reaches `level`. Height is monotone along rows and columns, rounding included: corners decide.
Part partThatReaches(const ImageLevel& level, const PixelRect& rect) {
  const int corners = level.isReachedBy({rect.u_min, rect.v_min}) + level.isReachedBy({rect.u_max, rect.v_min}) +
                      level.isReachedBy({rect.u_min, rect.v_max}) + level.isReachedBy({rect.u_max, rect.v_max});
  if (corners == 0) return Part::kNone;
  return corners == 4 ? Part::kAll : Part::kSome;
}

}  // namespace

bool hasReturnWithin(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level) {
  constexpr int kEdge_px = DepthTiles::kEdge_px;
  const DepthTiles& tiles = view.tiles();
  const CameraModel& camera = view.camera();
  for (int row = rect.v_min / kEdge_px; row <= rect.v_max / kEdge_px; ++row) {
    for (int column = rect.u_min / kEdge_px; column <= rect.u_max / kEdge_px; ++column) {
      const std::uint16_t least = tiles.least()[tiles.tileAt(column, row)];
      if (!isWithin(camera, least, limit_m)) continue;
      const PixelRect tile{column * kEdge_px, std::min((column + 1) * kEdge_px, camera.width()) - 1, row * kEdge_px,
                           std::min((row + 1) * kEdge_px, camera.height()) - 1};
      const PixelRect part{std::max(tile.u_min, rect.u_min), std::min(tile.u_max, rect.u_max),
                           std::max(tile.v_min, rect.v_min), std::min(tile.v_max, rect.v_max)};
      const Part reaching = partThatReaches(level, part);
      if (reaching == Part::kNone) continue;
      const bool whole = part == tile && reaching == Part::kAll;
      if (whole && least != DepthTiles::kNoDepth) return true;
      if (scanPixels(view, part, limit_m, level)) return true;
    }
  }
  return false;
}

}  // namespace nanomap
