#pragma once

#include <memory>
#include <vector>

#include "core/camera_model.h"
#include "core/geometry.h"
#include "tools/simulation/triangle_mesh.h"

namespace nanomap::simulation {

/// Depth of a triangle mesh as a camera sees it, without any error. Same bytes on every x86-64 machine: the instruction
/// set is pinned.
/// Threads: any number may render at once.
class RayCaster {
 public:
  /// @throws std::runtime_error with Embree's reason if the mesh cannot be prepared
  explicit RayCaster(const TriangleMesh& mesh);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// Depth along the optical axis [m] of every pixel, row-major; infinity where the ray meets nothing. No range limit
  /// is applied.
  [[nodiscard]] std::vector<float> render(const CameraModel& camera, const Pose& T_W_C) const;

 private:
  struct Embree;
  std::unique_ptr<const Embree> embree_;
};

}  // namespace nanomap::simulation
