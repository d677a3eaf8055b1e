#include "tools/simulation/ray_caster.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tools/simulation/scene.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::simulation {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

CameraParameters smallCamera() {
  CameraParameters camera;
  camera.width_px = 37;  // no multiple of a packet
  camera.height_px = 21;
  camera.fx_px = 20.0;
  camera.fy_px = 21.0;
  camera.cx_px = 17.0;
  camera.cy_px = 11.0;
  camera.max_range_m = 20.0;
  return camera;
}

/// A camera at `p_W` that looks along W's x, upright.
Pose lookingAlongX(const Vec3& p_W) {
  Mat3 R_W_C;
  R_W_C << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return {Quat(R_W_C), p_W};
}

std::vector<float> renderSolid(const Solid& solid, const CameraModel& camera, const Pose& T_W_C) {
  TriangleMesh mesh;
  append(solid, mesh);
  return RayCaster(mesh).render(camera, T_W_C);
}

/// Ray of a pixel, with a component of 1 along the optical axis, from the pinhole formula.
Vec3 rayOf(const CameraParameters& camera, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  return {(static_cast<double>(pixel % width) - camera.cx_px) / camera.fx_px,
          (static_cast<double>(pixel / width) - camera.cy_px) / camera.fy_px, 1.0};
}

TEST(RayCaster, PlaneAcrossTheAxisIsAtTheSameDepthInEveryPixel) {
  const CameraModel camera(smallCamera());
  const auto depth_m = renderSolid(UprightBox{.center_W = {6.0, 0.0, 0.0}, .half_size_m = {1.0, 50.0, 50.0}}, camera,
                                   lookingAlongX(Vec3::Zero()));
  EXPECT_THAT(depth_m, testing::SizeIs(camera.pixelCount()));
  EXPECT_THAT(depth_m, testing::Each(testing::FloatNear(5.0F, 1e-5F)));
}

TEST(RayCaster, GroundHasTheDepthOfThePlaneThroughEachRay) {
  const CameraModel camera(smallCamera());
  constexpr double kAltitude_m = 3.0;
  Mission mission;
  mission.region_W = Box3(Vec3::Constant(-1.0), Vec3::Constant(1.0));
  const RayCaster caster(Scene("ground", mission, {}).mesh());
  const auto depth_m = caster.render(camera, lookingAlongX({0.0, 0.0, kAltitude_m}));
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const double down = rayOf(camera.parameters(), i).y();
    if (down > 0.05) {
      EXPECT_NEAR(static_cast<double>(depth_m[i]), kAltitude_m / down, 1e-4 * kAltitude_m / down) << "pixel " << i;
    } else if (down <= 0.0) {
      EXPECT_EQ(depth_m[i], kNothing) << "pixel " << i;
    }
  }
}

TEST(RayCaster, SphereHasItsAnalyticDepthUpToItsFacets) {
  const CameraModel camera(smallCamera());
  const Sphere sphere{{8.0, 1.0, -0.5}, 2.0};
  const Pose T_W_C = lookingAlongX({0.0, 0.2, 0.1});
  const auto depth_m = renderSolid(sphere, camera, T_W_C);
  const Vec3 center_C = T_W_C.inverse() * sphere.center_W;
  int hits = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const Vec3 ray_C = rayOf(camera.parameters(), i);
    const double a = ray_C.squaredNorm();
    const double b = ray_C.dot(center_C);
    const double c = center_C.squaredNorm() - sphere.radius_m * sphere.radius_m;
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) {
      EXPECT_EQ(depth_m[i], kNothing) << "pixel " << i;
    } else if (discriminant > 0.3 * a * sphere.radius_m * sphere.radius_m) {  // not grazing, where facets matter most
      EXPECT_NEAR(static_cast<double>(depth_m[i]), (b - std::sqrt(discriminant)) / a, 4.0 * kSphereTolerance_m) << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(RayCaster, TrunkHasItsAnalyticDepthUpToItsFacets) {
  const CameraModel camera(smallCamera());
  const Cylinder trunk{{5.0, 0.3, -20.0}, {5.0, 0.3, 20.0}, 0.5};
  const auto depth_m = renderSolid(trunk, camera, lookingAlongX(Vec3::Zero()));
  int hits = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    // In the horizontal plane: the ray is (1, -x) in W, the circle's centre (5, 0.3).
    const double left = -rayOf(camera.parameters(), i).x();
    const double a = 1.0 + left * left;
    const double b = 5.0 + 0.3 * left;
    const double discriminant = b * b - a * (25.0 + 0.09 - 0.25);
    if (discriminant < 0.0) {
      EXPECT_EQ(depth_m[i], kNothing) << "pixel " << i;
    } else if (discriminant > 0.05) {
      EXPECT_NEAR(static_cast<double>(depth_m[i]), (b - std::sqrt(discriminant)) / a, 4.0 * kCylinderTolerance_m) << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(RayCaster, FollowsTheCameraModelsDistortion) {
  CameraParameters parameters = smallCamera();
  parameters.distortion.k1 = -0.05;
  const CameraModel camera(parameters);
  constexpr double kAltitude_m = 2.0;
  Mission mission;
  mission.region_W = Box3(Vec3::Constant(-1.0), Vec3::Constant(1.0));
  const auto depth_m =
      RayCaster(Scene("ground", mission, {}).mesh()).render(camera, lookingAlongX({0, 0, kAltitude_m}));
  const std::size_t corner = camera.pixelCount() - 1;
  const double down = static_cast<double>(camera.rayTangents(corner).y());
  EXPECT_GT(std::abs(down - rayOf(parameters, corner).y()), 1e-3);
  EXPECT_NEAR(static_cast<double>(depth_m[corner]), kAltitude_m / down, 1e-4);
}

TEST(RayCaster, RenderedPointsLieOnTheNearestObstacle) {
  const Scene scene = makeScene("urban", 4);
  const CameraModel camera(smallCamera());
  const Pose T_W_C = lookingAlongX(scene.mission().start_W);
  const auto depth_m = RayCaster(scene.mesh()).render(camera, T_W_C);
  int returns = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (depth_m[i] == kNothing) continue;
    const Vec3 p_W = T_W_C * (rayOf(camera.parameters(), i) * static_cast<double>(depth_m[i]));
    const double nearest_m = std::min(std::abs(scene.distanceToNearestObstacle(p_W)), std::abs(p_W.z()));
    EXPECT_LT(nearest_m, 2.0 * kSphereTolerance_m) << "pixel " << i;
    ++returns;
  }
  EXPECT_GT(returns, 200);
}

TEST(RayCaster, EmptyMeshShowsNothing) {
  const CameraModel camera(smallCamera());
  EXPECT_THAT(RayCaster(TriangleMesh{}).render(camera, Pose{}), testing::Each(kNothing));
}

TEST(RayCaster, RepeatsItsBytes) {
  const TriangleMesh mesh = makeScene("forest", 2).mesh();
  const CameraModel camera(smallCamera());
  const Pose T_W_C = lookingAlongX({0.0, 0.0, 2.0});
  EXPECT_EQ(RayCaster(mesh).render(camera, T_W_C), RayCaster(mesh).render(camera, T_W_C));
}

}  // namespace
}  // namespace nanomap::simulation
