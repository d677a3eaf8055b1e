#pragma once

#include <Eigen/Geometry>
#include <variant>

#include "core/geometry.h"

namespace nanomap::simulation {

using Box3 = Eigen::AlignedBox3d;

/// A box that stands upright, turned about W's z.
struct UprightBox {
  Vec3 center_W = Vec3::Zero();
  Vec3 half_size_m = Vec3::Zero();
  double yaw_rad = 0.0;
};

/// A cylinder with flat ends, in any direction.
struct Cylinder {
  Vec3 base_W = Vec3::Zero();
  Vec3 top_W = Vec3::Zero();
  double radius_m = 0.0;
};

struct Sphere {
  Vec3 center_W = Vec3::Zero();
  double radius_m = 0.0;
};

/// What obstacles are made of: shapes whose distance is known in closed form.
using Solid = std::variant<UprightBox, Cylinder, Sphere>;

/// Exact distance from `p_W` to the surface [m], negative inside.
[[nodiscard]] double signedDistance(const Solid& solid, const Vec3& p_W);

/// An axis-aligned box in W that holds the whole solid.
[[nodiscard]] Box3 bounds(const Solid& solid);

}  // namespace nanomap::simulation
