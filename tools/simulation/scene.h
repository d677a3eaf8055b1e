#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"
#include "tools/simulation/solid.h"
#include "tools/simulation/triangle_mesh.h"

namespace nanomap::simulation {

/// What is to be flown in a scene.
struct Mission {
  Vec3 start_W = Vec3::Zero();
  Vec3 goal_W = Vec3::Zero();
  std::vector<Vec3> via_W;  ///< a flight along a given path passes these in turn; a planner needs none
  Box3 region_W;            ///< where the flight may lead; holds start and goal
};

/// A world to fly in: solid obstacles on a flat ground (z = 0), and a mission through them. W: z up.
/// Threads: immutable, any number of readers.
class Scene {
 public:
  Scene(std::string name, Mission mission, std::vector<Solid> obstacles);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Mission& mission() const { return mission_; }
  [[nodiscard]] const std::vector<Solid>& obstacles() const { return obstacles_; }

  /// Distance from `p_W` to the surface of the nearest obstacle [m], exact; negative inside one, infinite if the scene
  /// has none. The ground is no obstacle: it is p_W.z() away.
  [[nodiscard]] double distanceToNearestObstacle(const Vec3& p_W) const;

  /// Surfaces of all obstacles, and the ground far beyond the region.
  [[nodiscard]] TriangleMesh mesh() const;

 private:
  std::string name_;
  Mission mission_;
  std::vector<Solid> obstacles_;
  std::vector<Box3> bounds_W_;  ///< of each obstacle
};

}  // namespace nanomap::simulation
