#include "tools/simulation/scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "tools/simulation/random.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

double bruteForceDistance(const Scene& scene, const Vec3& p_W) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Solid& solid : scene.obstacles()) nearest_m = std::min(nearest_m, signedDistance(solid, p_W));
  return nearest_m;
}

class EveryScene : public testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryScene, testing::ValuesIn(kSceneNames),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_P(EveryScene, DistanceEqualsBruteForceEverywhere) {
  constexpr std::uint64_t kSeed = 3;
  const Scene scene = makeScene(GetParam(), kSeed);
  Random random(kSeed);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 share(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    const Box3& region_W = scene.mission().region_W;
    const Vec3 p_W = region_W.min() + share.cwiseProduct(region_W.sizes());
    const double expected_m = bruteForceDistance(scene, p_W);
    inside += expected_m < 0.0;
    ASSERT_EQ(scene.distanceToNearestObstacle(p_W), expected_m) << p_W.transpose() << ", seed " << kSeed;
  }
  EXPECT_GT(inside, 0) << "no point inside an obstacle was tried";
}

TEST_P(EveryScene, SameSeedGivesTheSameMesh) {
  const TriangleMesh first = makeScene(GetParam(), 7).mesh();
  const TriangleMesh second = makeScene(GetParam(), 7).mesh();
  EXPECT_EQ(first.vertices_W, second.vertices_W);
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST_P(EveryScene, AnotherSeedGivesAnotherMesh) {
  EXPECT_NE(makeScene(GetParam(), 7).mesh().vertices_W, makeScene(GetParam(), 8).mesh().vertices_W);
}

TEST_P(EveryScene, StartAndGoalAreFreeForEverySeed) {
  constexpr double kVehicle_m = 0.5;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Scene scene = makeScene(GetParam(), seed);
    const Mission& mission = scene.mission();
    EXPECT_GT(scene.distanceToNearestObstacle(mission.start_W), kVehicle_m) << "seed " << seed;
    EXPECT_GT(scene.distanceToNearestObstacle(mission.goal_W), kVehicle_m) << "seed " << seed;
    EXPECT_TRUE(mission.region_W.contains(mission.start_W));
    EXPECT_TRUE(mission.region_W.contains(mission.goal_W));
  }
}

TEST_P(EveryScene, TrianglesAreFewEnoughToRenderInMilliseconds) {
  EXPECT_LT(makeScene(GetParam(), 1).mesh().triangles.size(), 120'000U);
}

TEST(Scene, WithoutObstaclesDistanceIsInfinite) {
  EXPECT_EQ(Scene("empty", {}, {}).distanceToNearestObstacle(Vec3::Zero()), std::numeric_limits<double>::infinity());
}

TEST(Scene, WithTwoSolidsAroundAPointTheDeeperCounts) {
  const Scene scene("two", {}, {Sphere{Vec3::Zero(), 1.0}, Sphere{Vec3::Zero(), 3.0}, Sphere{Vec3::Zero(), 1.0}});
  EXPECT_DOUBLE_EQ(scene.distanceToNearestObstacle({0.5, 0.0, 0.0}), -2.5);
}

TEST(Scene, MeshReachesTheGroundFarBeyondTheRegion) {
  Mission mission;
  mission.region_W = Box3(Vec3(-1.0, -2.0, 0.0), Vec3(1.0, 2.0, 3.0));
  const TriangleMesh mesh = Scene("ground", mission, {}).mesh();
  ASSERT_EQ(mesh.triangles.size(), 2U);
  for (const Vec3f& vertex_W : mesh.vertices_W) {
    EXPECT_EQ(vertex_W.z(), 0.0F);
    EXPECT_GT(vertex_W.head<2>().cwiseAbs().minCoeff(), 50.0F);
  }
}

TEST(SceneCatalogue, UnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_THAT(
      [] { (void)makeScene("forrest", 1); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("forrest"), HasSubstr("forest wall warehouse urban"))));
}

TEST(WallScene, StandsAcrossTheWayAHundredMetresAheadUnderAnOverhang) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene = makeScene("wall", seed);
    const Mission& mission = scene.mission();
    EXPECT_EQ(mission.start_W, Vec3(0.0, 0.0, 5.0));
    EXPECT_DOUBLE_EQ((mission.goal_W - mission.start_W).norm(), 200.0);
    for (double y_m = -15.0; y_m <= 15.0; y_m += 0.5) {
      EXPECT_LT(scene.distanceToNearestObstacle({101.0, y_m, 5.0}), 0.0) << "wall, seed " << seed;
    }
    EXPECT_LT(scene.distanceToNearestObstacle({97.0, 0.0, 6.5}), 0.0) << "overhang, seed " << seed;
    EXPECT_GT(scene.distanceToNearestObstacle({97.0, 3.0, 5.0}), 0.0) << "below the overhang, seed " << seed;
  }
}

}  // namespace
}  // namespace nanomap::simulation
