#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/box_groups.h"
#include "core/geometry.h"
#include "core/raw_range.h"
#include "core/ray_tiles.h"
#include "core/tiled_image.h"

namespace nanomap {

/// What a search reads: all that describes the points of one indexed image.
struct IndexedImage {
  const BoxGroups& boxes;
  const TiledImage& image;
  const RayTiles& rays;
  const RawRange& in_range;
  float depth_unit_m;
};

/// An indexed pixel, by tile and place in it. Not initialised: to clear the sixteen that a query has room for takes up
/// to 3 % of it.
struct FoundPixel {
  float distance_sq_m2;
  std::uint32_t pixel;  ///< tile * TileGrid::kTilePixels + place in the tile
};

/// Fills `out` with the nearest points to `p_C` whose squared distance, in float arithmetic over (x, y, z) in that
/// order, is at most `limit_sq_m2`: by ascending distance, equal ones by pixel.
/// @param limit_sq_m2  finite, zero or more
/// @pre p_C is finite, out.size() is 1 .. kMaxNeighbours
/// @return how many there are, at most out.size()
/// Allocates: no. The same result, bit by bit, on every instruction set.
[[nodiscard]] std::size_t findNearest(const IndexedImage& indexed, const Vec3f& p_C, float limit_sq_m2,
                                      std::span<FoundPixel> out);

}  // namespace nanomap
