#include "core/return_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace nanomap {
namespace {

constexpr int kEdge_px = DepthTiles::kEdge_px;

/// The greatest raw value whose depth is at most `limit_m`; negative if there is none.
int greatestRawWithin(const CameraModel& camera, double limit_m) {
  constexpr int kGreatest = std::numeric_limits<std::uint16_t>::max();
  const auto isWithin = [&](int raw) {
    return static_cast<double>(camera.depth(static_cast<std::uint16_t>(raw))) <= limit_m;
  };
  if (!isWithin(0)) return -1;
  int raw = static_cast<int>(std::min(limit_m / static_cast<double>(camera.depth(1)), double{kGreatest}));
  while (!isWithin(raw)) --raw;
  while (raw < kGreatest && isWithin(raw + 1)) ++raw;
  return raw;
}

/// What a search looks for.
struct Wanted {
  int greatest_raw;
  ImageLevel level;
};

bool scanPixels(const View& view, const PixelRect& rect, const Wanted& wanted) {
  for (int v = rect.v_min; v <= rect.v_max; ++v) {
    for (int u = rect.u_min; u <= rect.u_max; ++u) {
      const std::uint16_t raw = view.rawAt(u, v);
      if (raw > wanted.greatest_raw || view.camera().classify(raw) == DepthReading::kNone) continue;
      if (wanted.level.isReachedBy({u, v})) return true;
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

/// Searches the part of `rect` that lies in one tile. @pre something in the tile is near enough, or has no depth
bool searchTile(const View& view, int column, int row, const PixelRect& rect, const Wanted& wanted) {
  const PixelRect tile{column * kEdge_px, std::min((column + 1) * kEdge_px, view.camera().width()) - 1, row * kEdge_px,
                       std::min((row + 1) * kEdge_px, view.camera().height()) - 1};
  const PixelRect part{std::max(tile.u_min, rect.u_min), std::min(tile.u_max, rect.u_max),
                       std::max(tile.v_min, rect.v_min), std::min(tile.v_max, rect.v_max)};
  const Part reaching = partThatReaches(wanted.level, part);
  if (reaching == Part::kNone) return false;
  const bool whole = part == tile && reaching == Part::kAll;
  const std::uint16_t least = view.tiles().least()[view.tiles().tileAt(column, row)];
  return (whole && least != DepthTiles::kNoDepth) || scanPixels(view, part, wanted);
}

}  // namespace

bool hasReturnWithin(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level) {
  const Wanted wanted{greatestRawWithin(view.camera(), limit_m), level};
  for (int row = rect.v_min / kEdge_px; row <= rect.v_max / kEdge_px; ++row) {
    const std::uint16_t* least = view.tiles().least().data() + view.tiles().tileAt(0, row);
    for (int column = rect.u_min / kEdge_px; column <= rect.u_max / kEdge_px; ++column) {
      if (least[column] <= wanted.greatest_raw && searchTile(view, column, row, rect, wanted)) return true;
    }
  }
  return false;
}

}  // namespace nanomap
