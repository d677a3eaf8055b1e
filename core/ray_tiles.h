#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/tile_grid.h"

namespace nanomap {

/// One tangent (x/z or y/z) of the rays through a tile's pixels, row by row.
struct alignas(64) TangentTile {
  std::array<float, TileGrid::kTilePixels> tangents;
};

/// What a tangent is at least and at most along each line of pixels, columns for x/z and rows for y/z, of a block's
/// tiles: the place of line `line` of the tile in column `c`, row `r` of the block is `place(c, r, line)`.
/// So that a vector of any width loads half a line's worth of several tiles at once.
struct alignas(64) TangentBounds {
  static constexpr int kHalfLine = TileGrid::kTileEdge_px / 2;
  static constexpr int kPlaces = TileGrid::kBlockTiles * TileGrid::kTileEdge_px;
  static constexpr int kRowPlaces = kPlaces / TileGrid::kBlockEdge_tiles;
  static constexpr int kHalfRowPlaces = kRowPlaces / 2;

  std::array<float, kPlaces> least;
  std::array<float, kPlaces> greatest;

  [[nodiscard]] static constexpr std::size_t place(int tile_column, int tile_row, int line) {
    return static_cast<std::size_t>(tile_row * kRowPlaces + line / kHalfLine * kHalfRowPlaces +
                                    tile_column * kHalfLine + line % kHalfLine);
  }
};

/// A camera's rays in the order of its image's tiles. Where a column's pixels share x/z and a row's share y/z (no
/// distortion), tiles share their tangents too, and all of them fit into the nearest cache.
/// Threads: immutable, any number of readers. Allocates at construction.
class RayTiles {
 public:
  /// Tangent of what is not in the image: infinitely far aside at the raw depth that a TiledImage has there.
  static constexpr float kOutside = std::numeric_limits<float>::max();

  /// Of no image.
  RayTiles() = default;

  /// @param tangents  (x/z, y/z), row-major, one a pixel
  RayTiles(const TileGrid& grid, std::span<const Eigen::Vector2f> tangents);

  [[nodiscard]] const TileGrid& grid() const { return grid_; }
  [[nodiscard]] const TangentTile& x(std::size_t tile) const { return x_[of_tile_[tile].x]; }
  [[nodiscard]] const TangentTile& y(std::size_t tile) const { return y_[of_tile_[tile].y]; }
  [[nodiscard]] const TangentBounds& xBounds(std::size_t block) const { return x_bounds_[of_block_[block].x]; }
  [[nodiscard]] const TangentBounds& yBounds(std::size_t block) const { return y_bounds_[of_block_[block].y]; }

 private:
  struct Places {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
  };
  template <class Index>
  static Places placesOf(Index x, Index y) {
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
  }

  TileGrid grid_;
  std::vector<TangentTile> x_;
  std::vector<TangentTile> y_;
  std::vector<Places> of_tile_;
  std::vector<TangentBounds> x_bounds_;
  std::vector<TangentBounds> y_bounds_;
  std::vector<Places> of_block_;
};

}  // namespace nanomap
