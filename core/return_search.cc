#include "core/return_search.h"

#include <algorithm>
#include <bit>
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

/// Looks at the pixels of `part`, which lies in one tile, that carry a depth.
bool scanPixels(const View& view, const PixelRect& part, const Wanted& wanted) {
  static_assert(TileGrid::kTileEdge_px == kEdge_px);
  const TiledImage& image = view.image();
  const PixelTile& pixels = image.tiles()[image.grid().tileAt(part.u_min, part.v_min)];
  const DepthTiles& tiles = view.tiles();
  const DepthTiles::Gaps& gaps = tiles.gaps()[tiles.tileAt(part.u_min / kEdge_px, part.v_min / kEdge_px)];
  const int first_row = part.v_min - part.v_min % kEdge_px;
  const auto rows = (2U << (part.v_max - first_row)) - (1U << (part.v_min - first_row));
  for (int u = part.u_min; u <= part.u_max; ++u) {
    for (auto left = rows & ~std::uint32_t{gaps[static_cast<std::size_t>(u % kEdge_px)]}; left != 0; left &= left - 1) {
      const int v = first_row + std::countr_zero(left);
      const std::uint16_t raw = pixels.raw[TileGrid::placeInTile(u, v)];
      if (raw <= wanted.greatest_raw && wanted.level.isReachedBy({u, v})) return true;
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

/// The part of `rect` that lies in the rows from `v_min` on which a tile has.
PixelRect rowsOf(const PixelRect& rect, int v_min) {
  return {rect.u_min, rect.u_max, std::max(rect.v_min, v_min), std::min(rect.v_max, v_min + kEdge_px - 1)};
}

/// Searches the part of `band`, which lies in one row of tiles, that lies in one of them.
/// @param reaching  how much of the band reaches the level: some at least
/// @pre something in the tile is near enough, or has no depth
bool searchTile(const View& view, int column, const PixelRect& band, Part reaching, const Wanted& wanted) {
  const int row = band.v_min / kEdge_px;
  const PixelRect tile{column * kEdge_px, std::min((column + 1) * kEdge_px, view.camera().width()) - 1, row * kEdge_px,
                       std::min((row + 1) * kEdge_px, view.camera().height()) - 1};
  const PixelRect part{std::max(tile.u_min, band.u_min), std::min(tile.u_max, band.u_max), band.v_min, band.v_max};
  if (reaching == Part::kSome) reaching = partThatReaches(wanted.level, part);
  if (reaching == Part::kNone) return false;
  const bool whole = part == tile && reaching == Part::kAll;
  const std::uint16_t least = view.tiles().least()[view.tiles().tileAt(column, row)];
  return (whole && least != DepthTiles::kNoDepth) || scanPixels(view, part, wanted);
}

}  // namespace

bool hasReturnWithin(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level) {
  const Wanted wanted{greatestRawWithin(view.camera(), limit_m), level};
  for (int row = rect.v_min / kEdge_px; row <= rect.v_max / kEdge_px; ++row) {
    const PixelRect band = rowsOf(rect, row * kEdge_px);
    const Part reaching = partThatReaches(level, band);
    if (reaching == Part::kNone) continue;
    const std::uint16_t* least = view.tiles().least().data() + view.tiles().tileAt(0, row);
    for (int column = band.u_min / kEdge_px; column <= band.u_max / kEdge_px; ++column) {
      if (least[column] <= wanted.greatest_raw && searchTile(view, column, band, reaching, wanted)) return true;
    }
  }
  return false;
}

}  // namespace nanomap
