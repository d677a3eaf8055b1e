#pragma once

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/return_search.h"
#include "core/view.h"

namespace nanomap {

/// Sky rather than a hole, for a point at depth `z_m` behind pixels without depth in `gap`: nothing near in the window
/// around them, at the level of the lowest or above. What lies lower is the ground that the sky stands on; a pane has
/// its wall beside and above it. Seen from close by that frame leaves the window in pixels: then nothing may be seen
/// about as far away as the point within the frame's distance in metres.
/// @param up_C  the direction against gravity
/// @pre `gap` lies inside the image, and z_m is positive
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] bool isOpen(const View& view, const PixelRect& gap, double z_m, const Vec3& up_C,
                          const QueryOptions& options);

/// A glance at a few tiles above a pixel without depth: is one of them near enough that isOpen() denies it sky, at any
/// depth? What it leaves is for isOpen(). Costs a tenth of it, and sees most holes.
/// @pre `pixel` lies inside the image, and liesBelowGlance(up_C) holds for the direction against gravity
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] bool isHoleAtGlance(const View& view, CameraModel::Pixel pixel, const QueryOptions& options);

/// Is a pixel level with all of the tiles that isHoleAtGlance() looks at, or lower? The camera may roll by 28 degrees.
[[nodiscard]] bool liesBelowGlance(const Vec3& up_C);

}  // namespace nanomap
