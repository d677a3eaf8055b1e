#include "core/tiled_image.h"

#include <algorithm>
#include <cstring>

namespace nanomap {
namespace {

constexpr int kEdge_px = TileGrid::kTileEdge_px;

}  // namespace

TiledImage::TiledImage(TileGrid grid) : grid_(grid), tiles_(grid.tileCount()) {
  for (PixelTile& tile : tiles_) tile.raw.fill(kOutside);
}

void TiledImage::assign(std::span<const std::uint16_t> pixels) {
  for (int row = 0; row < grid_.blockRows(); ++row) {
    for (int column = 0; column < grid_.blockColumns(); ++column) assignBlock(pixels, column, row);
  }
}

void TiledImage::assignBlock(std::span<const std::uint16_t> pixels, int block_column, int block_row) {
  const int left = block_column * TileGrid::kBlockEdge_px;
  const int top = block_row * TileGrid::kBlockEdge_px;
  const int right = std::min(left + TileGrid::kBlockEdge_px, grid_.width_px);
  const int bottom = std::min(top + TileGrid::kBlockEdge_px, grid_.height_px);
  const auto width = static_cast<std::size_t>(grid_.width_px);
  for (int u = left; u < right; u += kEdge_px) {
    for (int tile_top = top; tile_top < bottom; tile_top += kEdge_px) {
      std::uint16_t* to = tiles_[grid_.tileAt(u, tile_top)].raw.data();
      const std::uint16_t* from = &pixels[static_cast<std::size_t>(tile_top) * width + static_cast<std::size_t>(u)];
      if (u + kEdge_px <= right && tile_top + kEdge_px <= bottom) {
        for (int row = 0; row < kEdge_px; ++row, to += kEdge_px, from += width) {
          std::memcpy(to, from, kEdge_px * sizeof(std::uint16_t));
        }
        continue;
      }
      for (int v = tile_top; v < std::min(tile_top + kEdge_px, bottom); ++v, to += kEdge_px, from += width) {
        std::copy_n(from, std::min(kEdge_px, right - u), to);
      }
    }
  }
}

}  // namespace nanomap
