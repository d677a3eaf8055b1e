#include "core/image_index.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/flann_index.h"
#include "tests/support/drawing.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/nearest_oracle.h"

namespace nanomap {
namespace {

using test::bruteForce;
using test::instructionSets;
using test::model;
using test::OnInstructionSet;
using test::pointsInRange;
using test::smallCamera;

constexpr unsigned kSeed = 7;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// An index, the image that it is of, and what it must hold.
struct Indexed {
  Indexed(std::shared_ptr<const CameraModel> of, DepthImage depth)
      : camera(std::move(of)),
        tiles({camera->width(), camera->height()}),
        index(camera, tiles),
        image(std::move(depth)),
        points_C(pointsInRange(image, *camera)) {
    index.build(image.pixels);
  }

  [[nodiscard]] std::vector<Neighbour> nearest(const Vec3f& p_C, std::size_t k,
                                               float max_distance_m = kInfinity) const {
    std::vector<Neighbour> found(k);
    found.resize(index.nearest(p_C, found, max_distance_m));
    return found;
  }

  std::shared_ptr<const CameraModel> camera;
  TiledImage tiles;
  ImageIndex index;
  DepthImage image;
  std::vector<Vec3f> points_C;
};

void expectExact(const Indexed& indexed, const Vec3f& p_C, float max_distance_m = kInfinity) {
  std::vector<float> expected_m = bruteForce(indexed.points_C, p_C);
  std::erase_if(expected_m, [&](float distance_m) { return distance_m > max_distance_m; });
  for (const std::size_t k : {1U, 2U, 10U, 16U}) {
    const std::vector<Neighbour> found = indexed.nearest(p_C, k, max_distance_m);
    ASSERT_EQ(found.size(), std::min(k, expected_m.size())) << "k " << k << " at " << p_C.transpose();
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].distance_m, expected_m[i]) << "neighbour " << i << " of " << k << " at " << p_C.transpose();
      ASSERT_EQ(bruteForce({found[i].point_C}, p_C).front(), expected_m[i]);
    }
  }
}

std::vector<Vec3f> queriesAround(const Indexed& indexed, std::mt19937& random, int count) {
  std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
  const auto anywhere = [&](float reach_m) {
    return Vec3f(reach_m * Vec3f(coordinate(random), coordinate(random), coordinate(random)));
  };
  std::vector<Vec3f> queries = {Vec3f::Zero(), Vec3f(0.0F, 0.0F, -5.0F), Vec3f(0.0F, 100.0F, 0.0F),
                                Vec3f(1e4F, 1e4F, -1e4F)};
  for (int i = 0; i < count; ++i) queries.push_back(anywhere(i % 3 == 0 ? 0.5F : 12.0F));
  if (!indexed.points_C.empty()) {
    queries.push_back(indexed.points_C.front());
    queries.push_back(indexed.points_C[random() % indexed.points_C.size()]);
  }
  return queries;
}

CameraParameters distortedCamera(int width_px, int height_px) {
  CameraParameters camera = smallCamera(width_px, height_px);
  camera.fx_px = camera.fy_px = std::max(width_px, height_px) / 1.5;
  camera.distortion = {-0.15, 0.04, 0.003, -0.002, 0.0};
  return camera;
}

class ImageIndexOn : public testing::TestWithParam<std::int64_t> {
 protected:
  OnInstructionSet target_{GetParam()};
};

TEST_P(ImageIndexOn, EqualsBruteForceForEverySizeOfImageAndCamera) {
  std::mt19937 random(kSeed);
  for (const auto& [width_px, height_px] : {std::pair(64, 48), {97, 61}, {33, 9}, {8, 8}, {5, 70}, {1, 1}}) {
    for (const CameraParameters& parameters :
         {smallCamera(width_px, height_px), distortedCamera(width_px, height_px)}) {
      const auto camera = model(parameters);
      for (const double no_return_share : {0.0, 0.3, 0.99}) {
        for (const std::uint16_t farthest :
             std::initializer_list<std::uint16_t>{500, 9900, 65534}) {  // smooth; mixed; mostly out of range
          const Indexed indexed(camera, test::randomImage(*camera, random, 150, farthest, no_return_share));
          for (const Vec3f& p_C : queriesAround(indexed, random, 12)) expectExact(indexed, p_C);
        }
      }
    }
  }
}

TEST_P(ImageIndexOn, EqualsBruteForceOnNoneOneAndEqualPoints) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(70, 50));
  const Indexed none(camera, test::flatImage(*camera, 0));
  EXPECT_EQ(none.index.size(), 0U);
  expectExact(none, Vec3f(0.1F, -0.2F, 1.5F));

  DepthImage one_point = test::flatImage(*camera, 0);
  one_point.pixels.back() = 2000;
  DepthImage near_and_far = test::flatImage(*camera, 2000);
  for (std::size_t i = 0; i < near_and_far.pixels.size(); i += 2) near_and_far.pixels[i] = 9000;
  for (const DepthImage& image : {one_point, near_and_far, test::flatImage(*camera, 2000)}) {
    const Indexed indexed(camera, image);
    EXPECT_EQ(indexed.index.size(), indexed.points_C.size());
    for (const Vec3f& p_C : queriesAround(indexed, random, 30)) expectExact(indexed, p_C);
  }
}

TEST_P(ImageIndexOn, FindsNothingBeyondTheRadius) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera());
  const Indexed indexed(camera, test::randomImage(*camera, random, 300, 9900, 0.3));
  for (const Vec3f& p_C : queriesAround(indexed, random, 30)) {
    const std::vector<float> all_m = bruteForce(indexed.points_C, p_C);
    for (const float radius_m : {0.0F, 1e-30F, 0.3F, 3.0F, all_m[0], all_m[5], std::nextafter(all_m[5], 0.0F), 1e30F}) {
      expectExact(indexed, p_C, radius_m);
    }
    for (const float radius_m : {-1.0F, -kInfinity, kNaN}) EXPECT_TRUE(indexed.nearest(p_C, 3, radius_m).empty());
  }
}

TEST_P(ImageIndexOn, FindsNothingNearAPointThatIsNotFinite) {
  const auto camera = model(smallCamera());
  const Indexed indexed(camera, test::flatImage(*camera, 2000));
  for (const float bad : {kNaN, kInfinity, -kInfinity, 1e30F}) {
    for (const Vec3f& p_C : {Vec3f(bad, 0, 1), Vec3f(0, bad, 1), Vec3f(0, 0, bad)}) {
      EXPECT_TRUE(indexed.nearest(p_C, 1).empty());
      EXPECT_TRUE(indexed.nearest(p_C, 16).empty());
    }
  }
}

TEST_P(ImageIndexOn, HoldsWhatTheCamerasOwnValuesLeave) {
  std::mt19937 random(kSeed);
  CameraParameters parameters = smallCamera(35, 21);
  parameters.min_range_m = 0.0;
  parameters.max_range_m = 100.0;
  for (const std::vector<std::uint16_t>& no_return_values :
       {std::vector<std::uint16_t>{}, {0}, {65535}, {0, 1000, 1002, 1002, 65535}}) {
    parameters.no_return_values = no_return_values;
    const auto camera = model(parameters);
    for (DepthImage image : {test::randomImage(*camera, random, 0, 65535, 0.2),
                             test::randomImage(*camera, random, 998, 1004, 0.2), test::flatImage(*camera, 1000)}) {
      image.pixels.back() = 65535;
      const Indexed indexed(camera, image);
      EXPECT_EQ(indexed.index.size(), indexed.points_C.size());
      for (const Vec3f& p_C : queriesAround(indexed, random, 20)) expectExact(indexed, p_C);
    }
  }
  parameters.min_range_m = 80.0;  // beyond what 16 bits hold
  const auto camera = model(parameters);
  expectExact(Indexed(camera, test::randomImage(*camera, random, 1, 65535, 0.0)), Vec3f::Zero());
}

TEST_P(ImageIndexOn, ForgetsTheImageBefore) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(97, 61));
  Indexed indexed(camera, test::randomImage(*camera, random, 300, 9900, 0.1));
  for (const DepthImage& next : {test::flatImage(*camera, 3000), test::randomImage(*camera, random, 300, 9900, 0.9),
                                 test::flatImage(*camera, 0)}) {
    indexed.image = next;
    indexed.points_C = pointsInRange(next, *camera);
    indexed.index.build(next.pixels);
    for (const Vec3f& p_C : queriesAround(indexed, random, 20)) expectExact(indexed, p_C);
  }
}

TEST_P(ImageIndexOn, EqualsBruteForceForEveryNumberOfNeighbours) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(97, 61));
  for (const std::uint16_t farthest : std::initializer_list<std::uint16_t>{3001, 9900}) {
    const Indexed indexed(camera, test::randomImage(*camera, random, 3000, farthest, 0.1));
    for (const Vec3f& p_C : queriesAround(indexed, random, 12)) {
      const std::vector<float> expected_m = bruteForce(indexed.points_C, p_C);
      for (std::size_t k = 1; k <= kMaxNeighbours; ++k) {
        const std::vector<Neighbour> found = indexed.nearest(p_C, k);
        ASSERT_EQ(found.size(), k);
        for (std::size_t i = 0; i < k; ++i) ASSERT_EQ(found[i].distance_m, expected_m[i]) << i << " of " << k;
      }
    }
  }
}

/// Groups are swept in several goes: what is found in one bounds the next.
TEST_P(ImageIndexOn, EqualsBruteForceOnAVeryLargeImage) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(1920, 1200));
  const Indexed indexed(camera, test::randomImage(*camera, random, 300, 9900, 0.1));
  for (const Vec3f& p_C : {Vec3f(0.5F, 0.2F, 2.0F), Vec3f(0.0F, 1.0F, 0.1F), Vec3f(-9.0F, 3.0F, 9.0F)}) {
    expectExact(indexed, p_C);
  }
}

TEST_P(ImageIndexOn, GivesEqualDistancesInTheOrderOfTilesAndTheirPixels) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(97, 61));
  for (const DepthImage& image :
       {test::flatImage(*camera, 3000), test::randomImage(*camera, random, 3000, 3001, 0.1)}) {
    const Indexed indexed(camera, image);
    // On the optical axis, mirrored pixels are equally far away.
    for (const Vec3f& p_C : {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(0, 0, 2.9F), Vec3f(0, 0, 100), Vec3f(0.3F, 0, 2)}) {
      const std::vector<Vec3f> expected_C = test::nearestInTileOrder(image, *camera, p_C, kMaxNeighbours);
      for (const std::size_t k : {1U, 2U, 5U, 16U}) {
        const std::vector<Neighbour> found = indexed.nearest(p_C, k);
        ASSERT_EQ(found.size(), k);
        for (std::size_t i = 0; i < k; ++i) ASSERT_EQ(found[i].point_C, expected_C[i]) << i << " of " << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Target, ImageIndexOn, testing::ValuesIn(instructionSets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

TEST(ImageIndex, GivesTheSamePointsInTheSameOrderOnEveryTarget) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(97, 61));
  for (const DepthImage& image : {test::flatImage(*camera, 3000), test::randomImage(*camera, random, 3000, 3001, 0.1),
                                  test::randomImage(*camera, random, 300, 9900, 0.1)}) {
    // On the optical axis, mirrored pixels are equally far away.
    std::vector<Vec3f> queries = {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(0.01F, 0, 2)};
    for (int i = 0; i < 50; ++i) queries.push_back(Vec3f::Random());
    std::vector<std::vector<Neighbour>> first;
    for (const std::int64_t target : instructionSets()) {
      const OnInstructionSet on(target);
      const Indexed indexed(camera, image);
      std::vector<std::vector<Neighbour>> found;
      for (const Vec3f& p_C : queries) {
        for (const std::size_t k : {1U, 10U, 16U}) found.push_back(indexed.nearest(p_C, k));
      }
      if (first.empty()) first = found;
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].size(), first[i].size());
        for (std::size_t j = 0; j < found[i].size(); ++j) {
          EXPECT_EQ(found[i][j].point_C, first[i][j].point_C) << hwy::TargetName(target);
          EXPECT_EQ(found[i][j].distance_m, first[i][j].distance_m) << hwy::TargetName(target);
        }
      }
    }
  }
}

TEST(ImageIndex, EqualsFlannWithAndWithoutARadius) {
  std::mt19937 random(kSeed);
  const auto camera = model(smallCamera(160, 120));
  const Indexed indexed(camera, test::randomImage(*camera, random, 300, 9900, 0.3));
  const auto flann = buildFlannIndex(indexed.image, *camera);
  ASSERT_EQ(indexed.index.size(), flann->size());
  std::array<Neighbour, kMaxNeighbours> expected;
  for (const Vec3f& p_C : queriesAround(indexed, random, 2000)) {
    for (const float radius_m : {0.2F, 2.0F, kInfinity, -1.0F}) {
      const std::vector<Neighbour> found = indexed.nearest(p_C, expected.size(), radius_m);
      ASSERT_EQ(found.size(), flann->nearest(p_C, expected, radius_m));
      for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i].distance_m, expected[i].distance_m);
    }
  }
}

}  // namespace
}  // namespace nanomap
