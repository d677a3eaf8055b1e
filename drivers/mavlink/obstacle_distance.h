#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/snapshot.h"
#include "core/view.h"

namespace nanomap {

/// OBSTACLE_DISTANCE in MAV_FRAME_BODY_FRD: the horizontal distance to the nearest obstacle, by bearing. Cell 0 is
/// centred straight ahead, the others follow clockwise.
struct ObstacleDistances {
  static constexpr std::size_t kCells = 72;
  static constexpr double kCellWidth_deg = 5.0;
  static constexpr std::uint16_t kTouching = 0;  ///< nearer than the sensor can measure
  static constexpr std::uint16_t kUnknown = 65535;

  Time stamp{};
  std::uint16_t min_distance_cm = 0;
  std::uint16_t max_distance_cm = 0;
  std::array<std::uint16_t, kCells> cells_cm = allUnknown();

  /// Value of a cell that is free as far as the sensor reaches.
  [[nodiscard]] std::uint16_t clear() const { return static_cast<std::uint16_t>(max_distance_cm + 1); }

 private:
  static constexpr std::array<std::uint16_t, kCells> allUnknown() {
    std::array<std::uint16_t, kCells> cells{};
    cells.fill(kUnknown);
    return cells;
  }
};

/// What counts as an obstacle: a return between these heights, against B's origin in the level frame. Below it is the
/// ground that one flies over, above it what one flies under.
struct ObstacleBand {
  double below_m = 0.5;
  double above_m = 0.5;
};

/// The cells that `view` sees. A cell without an obstacle is clear only if the view is free or open, as core judges it
/// (classify.h), on level rays across the cell up to max_distance; else it stays unknown.
/// @param T_L_C  where the view's camera is, in the level frame of the body (core/level_frame.h)
/// Allocates: no. Linear in the pixels. Threads: a function of its arguments.
[[nodiscard]] ObstacleDistances obstacleDistances(const View& view, const Pose& T_L_C, const ObstacleBand& band,
                                                  const QueryOptions& options);

/// The same for the newest view of a snapshot, in the level frame of the snapshot's body; stamped with the view's time.
/// Without a view everything is unknown.
[[nodiscard]] ObstacleDistances obstacleDistances(const ChainSnapshot& snapshot, const ObstacleBand& band,
                                                  const QueryOptions& options);

}  // namespace nanomap
