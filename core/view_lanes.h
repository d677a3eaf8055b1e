#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/depth_tiles.h"
#include "core/view.h"

namespace nanomap {

inline constexpr std::size_t kViewLanes = 16;  ///< as many floats as the widest vector unit holds

/// What the filter needs to know of sixteen neighbouring views of a snapshot, in structure-of-arrays form. A lane
/// without a view has an infinite near plane.
struct alignas(64) ViewLanes {
  using Floats = std::array<float, kViewLanes>;

  std::array<std::array<Floats, 3>, 3> R_C_B;  ///< row by row
  std::array<Floats, 3> t_C_B_m;
  std::array<Floats, 3> edge_variance_C_m2;  ///< diagonal of the accumulated covariance
  Floats tan_left, tan_right, tan_top, tan_bottom;
  Floats near_m, far_m;
  Floats cells_per_tan_x, cells_per_tan_y;  ///< cells as of CameraModel::pixelOfCell()
  Floats last_column, last_row;
  Floats counts_per_m;                                     ///< raw depth
  std::array<std::int32_t, kViewLanes> tile_columns;       ///< of the image
  std::array<const DepthTiles::Cover*, kViewLanes> cover;  ///< of DepthTiles
  std::array<const View*, kViewLanes> view;
  std::uint32_t tiled = 0;    ///< bits of the lanes whose cells are pixels: no distortion
  std::uint32_t upright = 0;  ///< bits of the lanes where liesBelowGlance() holds
};

/// Of sixteen neighbouring blocks, which are the views of a ViewLanes each: how far inside a plane of the frustum a
/// point p_B can be in any view of the block, times the length of the plane's normal, is
///     normal_B . p_B + spread_B . |p_B| + offset_m
/// at most. A lane without a block has offsets of minus infinity.
struct alignas(64) BlockLanes {
  static constexpr std::size_t kPlanes = 6;
  using Floats = ViewLanes::Floats;

  struct Plane {
    std::array<Floats, 3> normal_B;
    std::array<Floats, 3> spread_B;
    Floats offset_m;
  };
  std::array<Plane, kPlanes> planes;
};

/// An uncertain point as the filter takes it: rounded, with what rounding can do to it.
struct PointProbe {
  std::array<float, 3> mean_B_m;
  std::array<float, 6> covariance_B_m2;  ///< xx, yy, zz, xy, xz, yz
  float margin_m;                        ///< of the box, on all sides
  float slack_m;                         ///< above every error of a length or a distance times (1 + tangent)
  float slack_m2;                        ///< above every error of a variance
};

/// Where the mean falls in the views of a block that the filter left, and where to go on.
struct ProbedLanes {
  std::size_t block = 0;           ///< that the lanes are of
  std::size_t groups_entered = 0;  ///< of sixteen blocks
  std::uint32_t blocks_ahead = 0;  ///< bits of those in the group entered last that are to be probed
  std::uint32_t left = 0;          ///< bits of the lanes that may answer
  std::uint32_t in_cell = 0;       ///< bits of the lanes whose cell is certain
  alignas(64) std::array<std::int32_t, kViewLanes> column;
  alignas(64) std::array<std::int32_t, kViewLanes> row;
  alignas(64) std::array<std::int32_t, kViewLanes> tile;  ///< of the cell
  alignas(64) std::array<std::int32_t, kViewLanes> raw;   ///< the mean is certainly not nearer than this raw depth
};

}  // namespace nanomap
