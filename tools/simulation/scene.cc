#include "tools/simulation/scene.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace nanomap::simulation {

Scene::Scene(std::string name, Mission mission, std::vector<Solid> obstacles)
    : name_(std::move(name)), mission_(std::move(mission)), obstacles_(std::move(obstacles)) {
  bounds_W_.reserve(obstacles_.size());
  for (const Solid& solid : obstacles_) bounds_W_.push_back(bounds(solid));
}

double Scene::distanceToNearestObstacle(const Vec3& p_W) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const bool inside = nearest_m < 0.0;
    const double bound_sq_m2 = bounds_W_[i].squaredExteriorDistance(p_W);
    if (inside ? bound_sq_m2 > 0.0 : bound_sq_m2 > nearest_m * nearest_m) continue;
    nearest_m = std::min(nearest_m, signedDistance(obstacles_[i], p_W));
  }
  return nearest_m;
}

TriangleMesh Scene::mesh() const {
  constexpr double kGroundBeyondRegion_m = 100.0;  // farther than any depth camera sees
  TriangleMesh mesh;
  for (const Solid& solid : obstacles_) append(solid, mesh);
  const Vec3 beyond_m = Vec3::Constant(kGroundBeyondRegion_m);
  appendGround({mission_.region_W.min() - beyond_m, mission_.region_W.max() + beyond_m}, mesh);
  return mesh;
}

}  // namespace nanomap::simulation
