#pragma once

#include <optional>

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/view.h"

namespace nanomap {

/// A point, and how far around it a view is searched for what it has not seen.
struct UnseenSearch {
  const View& view;
  Vec3f p_C;   ///< @pre inside the frustum
  Vec3f up_C;  ///< the direction against gravity
  const QueryOptions& options;
  float radius_m;                     ///< nothing farther is of interest
  float enough_m;                     ///< by how much something is nearer than this is of no interest
  std::optional<Vec3f> look_first_C;  ///< where something unseen may be
};

struct NearestUnseen {
  float distance_m = 0.0F;  ///< `radius_m` if there is nothing nearer; maybe not the least if it is at most `enough_m`
  std::optional<Vec3f> at_C;  ///< where that is
};

/// The nearest point of the unseen part of any ray, as core/vouched_ball.h has it. The same on every instruction set.
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] NearestUnseen nearestUnseen(const UnseenSearch& search);

}  // namespace nanomap
