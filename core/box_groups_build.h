#pragma once

#include <cstdint>
#include <span>

#include "core/box_groups.h"
#include "core/raw_range.h"
#include "core/ray_tiles.h"
#include "core/tiled_image.h"

namespace nanomap {

/// Cuts a depth image into tiles and groups their boxes, in one pass over its pixels.
/// @param pixels        row-major, of the image's size
/// @param in_range      what is indexed; the bounds of a tile may include `in_range.excluded`
/// @param depth_unit_m  metres per count
/// @param image, boxes  storage of that size, overwritten
/// Allocates: no. The same result, bit by bit, on every instruction set.
void buildBoxGroups(std::span<const std::uint16_t> pixels, const RayTiles& rays, const RawRange& in_range,
                    float depth_unit_m, TiledImage& image, BoxGroups& boxes);

}  // namespace nanomap
