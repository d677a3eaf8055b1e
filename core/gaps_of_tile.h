#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/camera_model.h"
#include "core/depth_tiles.h"
#include "core/view.h"

namespace nanomap {

/// The gaps among the depths that pixels of one tile lie in, along their rows and columns. Borrows the view.
class GapsOfTile {
 public:
  static constexpr int kWidest_px = DepthTiles::kEdge_px;

  /// @param column, row  of the tile, as of core/depth_tiles.h
  GapsOfTile(const View& view, int column, int row);

  /// For a pixel of the tile that carries no depth: if the gap in its row or the one in its column is at most
  /// `widest_px` pixels wide and has a return at either end, the nearest of its ends, or of both gaps' [m]. Empty if
  /// both are wider, or reach the image's border. @pre widest_px <= kWidest_px
  [[nodiscard]] std::optional<float> narrowDepth_m(CameraModel::Pixel pixel, int widest_px) const;

 private:
  /// Bits 8 .. 15 are the tile's pixels along a line, the eight below and above those of the tiles before and after:
  /// set if there is no depth, or no image.
  using Line = std::uint32_t;

  const View& view_;
  std::array<Line, DepthTiles::kEdge_px> rows_;
  std::array<Line, DepthTiles::kEdge_px> columns_;
};

}  // namespace nanomap
