#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/tile_grid.h"

namespace nanomap {

/// Boxes a group holds: as many as a block has tiles, and lanes of the widest vector.
inline constexpr std::size_t kGroupBoxes = 16;

using BoxLanes = std::array<float, kGroupBoxes>;

/// Axis-aligned boxes in C [m], axis by axis. An unused lane holds a box at `kNoBox_m`: its distance squared is
/// infinite.
struct alignas(64) BoxBounds {
  static constexpr float kNoBox_m = 3e38F;

  std::array<BoxLanes, 3> low_m;
  std::array<BoxLanes, 3> high_m;
};

/// Boxes around measured points that lie near one another: each around the pixels of one tile whose raw depth is in
/// `raw_low` .. `raw_high`. A tile of mixed depth has two boxes, near and far, of which no pixel is in both.
struct BoxGroup {
  BoxBounds bounds;
  std::array<std::uint16_t, kGroupBoxes> raw_low;
  std::array<std::uint16_t, kGroupBoxes> raw_high;
  std::array<std::uint32_t, kGroupBoxes> tile;
};

/// What is known of sixteen groups.
struct GroupBounds {
  BoxBounds boxes;
  /// Added to the squared distance of a group's bounds it makes a guess at that of the group's nearest point: the wider
  /// the bounds, and the fewer the boxes in them, the farther from where they begin is what they hold.
  BoxLanes spread_m2;
};

/// The hierarchy over one depth image: groups of boxes, each of one block, and the bounds of each group.
/// Bounds are exact: the least and greatest coordinates, in float arithmetic, of what they hold.
struct BoxGroups {
  /// A block's boxes, at most two a tile, fill at most this many groups.
  static constexpr std::size_t kMaxGroupsOfBlock = 2;

  explicit BoxGroups(const TileGrid& grid)
      : groups(grid.blockCount() * kMaxGroupsOfBlock), bounds((groups.size() + kGroupBoxes - 1) / kGroupBoxes) {}

  std::vector<BoxGroup> groups;     ///< storage for as many as there can be; the first `count` are in use
  std::vector<GroupBounds> bounds;  ///< lane i % 16 of element i / 16 holds the bounds of group i
  std::size_t count = 0;
};

}  // namespace nanomap
