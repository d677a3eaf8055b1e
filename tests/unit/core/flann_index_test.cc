#include "core/flann_index.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/drawing.h"
#include "tests/support/nearest_oracle.h"

namespace nanomap {
namespace {

constexpr unsigned kSeed = 7;

void expectExact(const DepthImage& image, const CameraModel& camera, const Vec3f& p_C, std::size_t k) {
  const auto index = buildFlannIndex(image, camera);
  const std::vector<float> expected_m = test::bruteForce(test::pointsInRange(image, camera), p_C);
  std::vector<Neighbour> found(k);
  const std::size_t count = index->nearest(p_C, found);
  ASSERT_EQ(count, std::min(k, expected_m.size()));
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(found[i].distance_m, expected_m[i]) << "neighbour " << i << " of " << k << " at " << p_C.transpose();
    EXPECT_FLOAT_EQ(found[i].distance_m, (found[i].point_C - p_C).norm());
  }
}

class FlannIndex : public testing::TestWithParam<std::size_t> {};

TEST_P(FlannIndex, EqualsBruteForce) {
  const CameraModel camera(test::smallCamera());
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> coordinate(-12.0F, 12.0F);
  for (const double no_return_share : {0.0, 0.3, 0.99}) {
    const DepthImage image = test::randomImage(camera, random, 300, 9900, no_return_share);
    const auto index = buildFlannIndex(image, camera);
    const std::vector<Vec3f> points_C = test::pointsInRange(image, camera);
    for (int i = 0; i < 100; ++i) {
      const Vec3f p_C(coordinate(random), coordinate(random), coordinate(random));
      const std::vector<float> expected_m = test::bruteForce(points_C, p_C);
      std::vector<Neighbour> found(GetParam());
      const std::size_t count = index->nearest(p_C, found);
      ASSERT_EQ(count, std::min(GetParam(), expected_m.size()));
      for (std::size_t j = 0; j < count; ++j) ASSERT_EQ(found[j].distance_m, expected_m[j]);
    }
  }
}

TEST_P(FlannIndex, SurvivesDegenerateImages) {
  const CameraModel camera(test::smallCamera());
  const Vec3f p_C(0.1F, -0.2F, 1.5F);
  expectExact(test::flatImage(camera, 0), camera, p_C, GetParam());

  DepthImage one_point = test::flatImage(camera, 0);
  one_point.pixels[1234] = 2000;
  expectExact(one_point, camera, p_C, GetParam());

  const DepthImage wall = test::flatImage(camera, 2000);
  expectExact(wall, camera, p_C, GetParam());
  expectExact(wall, camera, camera.deproject(1234, 2000), GetParam());  // on a point
  expectExact(wall, camera, {0.0F, 0.0F, -5.0F}, GetParam());           // behind the camera
  expectExact(wall, camera, {0.0F, 100.0F, 0.0F}, GetParam());          // far away
}

INSTANTIATE_TEST_SUITE_P(Neighbours, FlannIndex, testing::Values(1, 2, 10, 16));

}  // namespace
}  // namespace nanomap
