#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/tile_grid.h"

namespace nanomap {

/// Between which tangents the rays of an image's columns and rows of tiles lie (tiles as of TileGrid and DepthTiles),
/// and how far apart neighbouring rays are. Threads: immutable, any number of readers. Allocates at construction.
class TileTangents {
 public:
  /// Of the columns or the rows of tiles, one after the other.
  struct Ranges {
    std::vector<float> least;
    std::vector<float> greatest;

    [[nodiscard]] std::size_t size() const { return least.size(); }
  };

  /// Of no image.
  TileTangents() = default;

  /// @param tangents  (x/z, y/z), row-major, one a pixel
  TileTangents(const TileGrid& grid, std::span<const Eigen::Vector2f> tangents);

  [[nodiscard]] const Ranges& columns() const { return columns_; }  ///< x/z
  [[nodiscard]] const Ranges& rows() const { return rows_; }        ///< y/z

  /// How far the tangents of neighbouring rays are apart at most, diagonal neighbours included.
  [[nodiscard]] double pixel() const { return pixel_; }

 private:
  Ranges columns_;
  Ranges rows_;
  double pixel_ = 0.0;
};

}  // namespace nanomap
