#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/simulation/solid.h"

namespace nanomap::simulation {

/// Triangles in W, for the ray caster.
struct TriangleMesh {
  std::vector<Vec3f> vertices_W;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
};

/// How far a facet may lie inside the round surface that it stands for. Vertices lie on the surface, so that the
/// closed-form distance is never farther than what is rendered.
inline constexpr double kCylinderTolerance_m = 0.002;
inline constexpr double kSphereTolerance_m = 0.05;

/// Adds the surface of `solid` to `mesh`.
void append(const Solid& solid, TriangleMesh& mesh);

/// Adds the ground, z = 0, below `area_W` (its x and y).
void appendGround(const Box3& area_W, TriangleMesh& mesh);

}  // namespace nanomap::simulation
