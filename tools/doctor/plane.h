#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/geometry.h"

namespace nanomap::doctor {

/// A plane that points measured from the origin lie on.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< towards the origin
  double distance_m = 0.0;      ///< from the origin, 0 or more
  double share = 0.0;           ///< of the points that lie on it, 0 to 1
  double share_behind = 0.0;    ///< of those that lie clearly beyond it
};

/// The plane of those with an eligible normal that most points lie on, within what a depth camera errs: found by trials
/// with three of them, then fitted to all that lie on it. The same points give the same plane.
/// Empty if there is none. Threads: a function of its arguments.
[[nodiscard]] std::optional<Plane> largestPlane(const std::vector<Vec3>& points,
                                                const std::function<bool(const Vec3& normal)>& eligible);

}  // namespace nanomap::doctor
