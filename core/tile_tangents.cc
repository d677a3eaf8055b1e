#include "core/tile_tangents.h"

#include <algorithm>
#include <limits>

namespace nanomap {
namespace {

TileTangents::Ranges emptyRanges(int pixels) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto tiles = static_cast<std::size_t>((pixels + TileGrid::kTileEdge_px - 1) / TileGrid::kTileEdge_px);
  return {std::vector<float>(tiles, kInfinity), std::vector<float>(tiles, -kInfinity)};
}

void include(TileTangents::Ranges& ranges, int pixel, float tangent) {
  const auto tile = static_cast<std::size_t>(pixel / TileGrid::kTileEdge_px);
  ranges.least[tile] = std::min(ranges.least[tile], tangent);
  ranges.greatest[tile] = std::max(ranges.greatest[tile], tangent);
}

}  // namespace

TileTangents::TileTangents(const TileGrid& grid, std::span<const Eigen::Vector2f> tangents)
    : columns_(emptyRanges(grid.width_px)), rows_(emptyRanges(grid.height_px)) {
  const auto at = [&](int u, int v) -> Eigen::Vector2d {
    const auto row = static_cast<std::size_t>(v) * static_cast<std::size_t>(grid.width_px);
    return tangents[row + static_cast<std::size_t>(u)].cast<double>();
  };
  for (int v = 0; v < grid.height_px; ++v) {
    for (int u = 0; u < grid.width_px; ++u) {
      const Eigen::Vector2d ray = at(u, v);
      include(columns_, u, static_cast<float>(ray.x()));
      include(rows_, v, static_cast<float>(ray.y()));
      if (u == 0 || v == 0) continue;
      pixel_ = std::max({pixel_, (ray - at(u - 1, v - 1)).norm(), (at(u, v - 1) - at(u - 1, v)).norm()});
    }
  }
}

}  // namespace nanomap
