#include "tools/simulation/solid.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tools/simulation/random.h"
#include "tools/simulation/triangle_mesh.h"

namespace nanomap::simulation {
namespace {

constexpr std::uint64_t kSeed = 5;

Vec3 randomPoint(Random& random, double reach_m) {
  const double x = uniform(random, -reach_m, reach_m);
  const double y = uniform(random, -reach_m, reach_m);
  const double z = uniform(random, -reach_m, reach_m);
  return {x, y, z};
}

Solid randomSolid(Random& random, int kind) {
  const Vec3 center_W = randomPoint(random, 1.0);
  const double size_m = uniform(random, 0.3, 1.0);
  if (kind == 0) {
    return UprightBox{.center_W = center_W, .half_size_m = {size_m, 0.3, 0.6}, .yaw_rad = uniform(random, -3.0, 3.0)};
  }
  if (kind == 1) return Cylinder{center_W, center_W + randomPoint(random, 1.0) + Vec3(0.2, 0.0, 0.0), size_m};
  return Sphere{center_W, size_m};
}

/// Points spread over every triangle, so close together that the nearest one is within `kSpacing_m` of the nearest of
/// all.
constexpr double kSpacing_m = 0.03;
std::vector<Vec3> sampleSurface(const TriangleMesh& mesh) {
  std::vector<Vec3> points_W;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices_W[triangle[0]].cast<double>();
    const Vec3 ab = mesh.vertices_W[triangle[1]].cast<double>() - a;
    const Vec3 ac = mesh.vertices_W[triangle[2]].cast<double>() - a;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::max(ab.norm(), ac.norm()) / kSpacing_m)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) points_W.emplace_back(a + ab * i / steps + ac * j / steps);
    }
  }
  return points_W;
}

TEST(Solid, DistanceEqualsBruteForceOverMeshSamples) {
  Random random(kSeed);
  for (int kind = 0; kind < 3; ++kind) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Solid solid = randomSolid(random, kind);
      TriangleMesh mesh;
      append(solid, mesh);
      const std::vector<Vec3> surface_W = sampleSurface(mesh);
      for (int i = 0; i < 50; ++i) {
        const Vec3 p_W = randomPoint(random, 4.0);
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const Vec3& q_W : surface_W) nearest_m = std::min(nearest_m, (q_W - p_W).norm());
        EXPECT_NEAR(std::abs(signedDistance(solid, p_W)), nearest_m, kSphereTolerance_m + kSpacing_m)
            << "kind " << kind << ", seed " << kSeed;
      }
    }
  }
}

TEST(Solid, MeshVerticesLieOnTheSurface) {
  Random random(kSeed);
  for (int kind = 0; kind < 3; ++kind) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Solid solid = randomSolid(random, kind);
      TriangleMesh mesh;
      append(solid, mesh);
      for (const Vec3f& vertex_W : mesh.vertices_W)
        EXPECT_NEAR(signedDistance(solid, vertex_W.cast<double>()), 0.0, 1e-6);
    }
  }
}

TEST(Solid, MeshFacetsStayWithinTheTolerance) {
  Random random(kSeed);
  for (int kind = 0; kind < 3; ++kind) {
    const Solid solid = randomSolid(random, kind);
    TriangleMesh mesh;
    append(solid, mesh);
    const double tolerance_m = kind == 0 ? 0.0 : kind == 1 ? kCylinderTolerance_m : kSphereTolerance_m;
    for (const Vec3& p_W : sampleSurface(mesh)) {
      EXPECT_LE(signedDistance(solid, p_W), 1e-6);
      EXPECT_GE(signedDistance(solid, p_W), -tolerance_m - 1e-6) << "kind " << kind;
    }
  }
}

TEST(Solid, EveryMeshIsClosed) {
  Random random(kSeed);
  for (int kind = 0; kind < 3; ++kind) {
    TriangleMesh mesh;
    append(randomSolid(random, kind), mesh);
    // Euler: a closed surface like a sphere has V - E + F = 2, and each edge belongs to two triangles.
    EXPECT_EQ(mesh.vertices_W.size() + mesh.triangles.size() - mesh.triangles.size() * 3 / 2, 2U) << "kind " << kind;
  }
}

TEST(Solid, DistanceInsideIsNegativeDepth) {
  EXPECT_DOUBLE_EQ(signedDistance(UprightBox{.half_size_m = {1.0, 2.0, 3.0}}, {0.5, 0.0, 0.0}), -0.5);
  EXPECT_DOUBLE_EQ(signedDistance(Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, 1.0}, {0.0, 0.0, 3.5}), -0.5);
  EXPECT_DOUBLE_EQ(signedDistance(Sphere{Vec3::Zero(), 2.0}, Vec3::Zero()), -2.0);
}

TEST(Solid, BoundsHoldTheMeshTightly) {
  constexpr double kSlack_m = 0.1;  // the sphere's facets
  Random random(kSeed);
  for (int kind = 0; kind < 3; ++kind) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Solid solid = randomSolid(random, kind);
      TriangleMesh mesh;
      append(solid, mesh);
      Box3 exact_W;
      for (const Vec3f& vertex_W : mesh.vertices_W) exact_W.extend(vertex_W.cast<double>());
      const Box3 box_W = bounds(solid);
      EXPECT_TRUE((box_W.min().array() <= exact_W.min().array() + 1e-6).all());
      EXPECT_TRUE((box_W.max().array() >= exact_W.max().array() - 1e-6).all());
      EXPECT_TRUE((box_W.min().array() >= exact_W.min().array() - kSlack_m).all());
      EXPECT_TRUE((box_W.max().array() <= exact_W.max().array() + kSlack_m).all());
    }
  }
}

}  // namespace
}  // namespace nanomap::simulation
