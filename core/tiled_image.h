#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/tile_grid.h"

namespace nanomap {

/// Raw depths of one tile, row by row.
struct alignas(64) PixelTile {
  std::array<std::uint16_t, TileGrid::kTilePixels> raw;
};

/// The raw depths of an image, tile by tile: neighbours in the image are neighbours in memory.
/// Threads: any number of readers; assigning needs the image alone.
class TiledImage {
 public:
  /// What places outside the image hold.
  static constexpr std::uint16_t kOutside = 65535;

  /// Allocates; nothing else does.
  explicit TiledImage(TileGrid grid);

  /// @pre as many pixels, row-major, as the grid's image has
  void assign(std::span<const std::uint16_t> pixels);

  /// The part of assign() that fills one block.
  void assignBlock(std::span<const std::uint16_t> pixels, int block_column, int block_row);

  [[nodiscard]] const TileGrid& grid() const { return grid_; }
  [[nodiscard]] std::span<const PixelTile> tiles() const { return tiles_; }

  /// Raw value at column `u`, row `v` inside the image.
  [[nodiscard]] std::uint16_t at(int u, int v) const { return tiles_[grid_.tileAt(u, v)].raw[grid_.placeInTile(u, v)]; }

 private:
  TileGrid grid_;
  std::vector<PixelTile> tiles_;
};

}  // namespace nanomap
