#include "core/ray_tiles.h"

#include <algorithm>

namespace nanomap {
namespace {

constexpr int kEdge_px = TileGrid::kTileEdge_px;
constexpr int kBlockEdge = TileGrid::kBlockEdge_tiles;

/// One tangent of every pixel, by column and row; beyond the border that of the nearest pixel inside.
class TangentImage {
 public:
  TangentImage(const TileGrid& grid, std::span<const Eigen::Vector2f> tangents, Eigen::Index axis)
      : grid_(grid), tangents_(tangents), axis_(axis) {}

  [[nodiscard]] bool has(int u, int v) const { return u < grid_.width_px && v < grid_.height_px; }

  [[nodiscard]] float at(int u, int v) const {
    const auto column = static_cast<std::size_t>(std::min(u, grid_.width_px - 1));
    const auto row = static_cast<std::size_t>(std::min(v, grid_.height_px - 1));
    return tangents_[row * static_cast<std::size_t>(grid_.width_px) + column][axis_];
  }

  [[nodiscard]] TangentTile tile(int left, int top) const {
    TangentTile out;
    for (int v = top; v < top + kEdge_px; ++v) {
      for (int u = left; u < left + kEdge_px; ++u) {
        out.tangents[TileGrid::placeInTile(u, v)] = has(u, v) ? at(u, v) : RayTiles::kOutside;
      }
    }
    return out;
  }

  /// @param along_columns  lines are columns (x/z), else rows (y/z)
  [[nodiscard]] TangentBounds bounds(int block_left, int block_top, bool along_columns) const {
    TangentBounds out;
    for (int column = 0; column < kBlockEdge; ++column) {
      for (int row = 0; row < kBlockEdge; ++row) {
        for (int line = 0; line < kEdge_px; ++line) {
          const int left = block_left + column * kEdge_px;
          const int top = block_top + row * kEdge_px;
          const auto on_line = [&](int i) {
            return along_columns ? at(left + line, top + i) : at(left + i, top + line);
          };
          float least = on_line(0);
          float greatest = least;
          for (int i = 1; i < kEdge_px; ++i) {
            least = std::min(least, on_line(i));
            greatest = std::max(greatest, on_line(i));
          }
          out.least[TangentBounds::place(column, row, line)] = least;
          out.greatest[TangentBounds::place(column, row, line)] = greatest;
        }
      }
    }
    return out;
  }

 private:
  TileGrid grid_;
  std::span<const Eigen::Vector2f> tangents_;
  Eigen::Index axis_;
};

/// Do all pixels of a column share x/z, and all of a row y/z?
bool isSeparable(const TileGrid& grid, const TangentImage& x, const TangentImage& y) {
  for (int v = 0; v < grid.height_px; ++v) {
    for (int u = 0; u < grid.width_px; ++u) {
      if (x.at(u, v) != x.at(u, 0) || y.at(u, v) != y.at(0, v)) return false;
    }
  }
  return true;
}

}  // namespace

RayTiles::RayTiles(const TileGrid& grid, std::span<const Eigen::Vector2f> tangents) : grid_(grid) {
  const TangentImage x(grid, tangents, 0);
  const TangentImage y(grid, tangents, 1);
  const bool separable = isSeparable(grid, x, y);

  of_tile_.reserve(grid.tileCount());
  for (std::size_t tile = 0; tile < grid.tileCount(); ++tile) {
    const auto [u, v] = grid.pixelAt(tile, 0);
    of_tile_.push_back(separable ? placesOf(u / kEdge_px, v / kEdge_px) : placesOf(tile, tile));
    if (!separable || v == 0) x_.push_back(x.tile(u, v));
    if (!separable || u == 0) y_.push_back(y.tile(u, v));
  }
  of_block_.reserve(grid.blockCount());
  for (std::size_t block = 0; block < grid.blockCount(); ++block) {
    const auto [u, v] = grid.pixelAt(block * TileGrid::kBlockTiles, 0);
    of_block_.push_back(separable ? placesOf(u / TileGrid::kBlockEdge_px, v / TileGrid::kBlockEdge_px)
                                  : placesOf(block, block));
    if (!separable || v == 0) x_bounds_.push_back(x.bounds(u, v, true));
    if (!separable || u == 0) y_bounds_.push_back(y.bounds(u, v, false));
  }
}

}  // namespace nanomap
