#pragma once

#include <cstddef>

namespace nanomap {

/// How an image is cut for the nearest-point index: into square tiles, and squares of tiles called blocks. Blocks
/// follow one another row by row, the tiles of a block column by column, the pixels of a tile row by row. Tiles reach
/// over the image's right and bottom border where its size is no multiple of theirs.
struct TileGrid {
  static constexpr int kTileEdge_px = 8;
  static constexpr int kTilePixels = kTileEdge_px * kTileEdge_px;
  static constexpr int kBlockEdge_tiles = 4;
  static constexpr int kBlockTiles = kBlockEdge_tiles * kBlockEdge_tiles;
  static constexpr int kBlockEdge_px = kBlockEdge_tiles * kTileEdge_px;

  int width_px = 0;
  int height_px = 0;

  bool operator==(const TileGrid&) const = default;

  [[nodiscard]] int blockColumns() const { return (width_px + kBlockEdge_px - 1) / kBlockEdge_px; }
  [[nodiscard]] int blockRows() const { return (height_px + kBlockEdge_px - 1) / kBlockEdge_px; }
  [[nodiscard]] std::size_t blockCount() const { return index(blockRows(), blockColumns(), 0); }
  [[nodiscard]] std::size_t tileCount() const { return blockCount() * kBlockTiles; }

  [[nodiscard]] std::size_t blockAt(int block_column, int block_row) const {
    return index(block_row, blockColumns(), block_column);
  }

  /// The tile that holds the pixel in column `u`, row `v`.
  [[nodiscard]] std::size_t tileAt(int u, int v) const {
    const std::size_t block = blockAt(u / kBlockEdge_px, v / kBlockEdge_px);
    return block * kBlockTiles +
           index(u % kBlockEdge_px / kTileEdge_px, kBlockEdge_tiles, v % kBlockEdge_px / kTileEdge_px);
  }

  /// That pixel's place in its tile.
  [[nodiscard]] static std::size_t placeInTile(int u, int v) {
    return index(v % kTileEdge_px, kTileEdge_px, u % kTileEdge_px);
  }

  struct Pixel {
    int u = 0;
    int v = 0;
  };
  [[nodiscard]] Pixel pixelAt(std::size_t tile, std::size_t place) const {
    const auto block = static_cast<int>(tile / kBlockTiles);
    const auto tile_in_block = static_cast<int>(tile % kBlockTiles);
    const auto pixel = static_cast<int>(place);
    return {
        block % blockColumns() * kBlockEdge_px + tile_in_block / kBlockEdge_tiles * kTileEdge_px + pixel % kTileEdge_px,
        block / blockColumns() * kBlockEdge_px + tile_in_block % kBlockEdge_tiles * kTileEdge_px +
            pixel / kTileEdge_px};
  }

 private:
  static std::size_t index(int major, int stride, int minor) {
    return static_cast<std::size_t>(major) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(minor);
  }
};

}  // namespace nanomap
