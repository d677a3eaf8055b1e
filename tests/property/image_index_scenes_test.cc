#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "core/flann_index.h"
#include "core/image_index.h"
#include "tests/support/camera.h"
#include "tests/support/nearest_oracle.h"
#include "tools/import/camera_preset.h"
#include "tools/import/depth_png.h"
#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/flight_path.h"
#include "tools/simulation/ray_caster.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr int kQueriesOfScenes = 100'000;
constexpr int kQueriesOfRecording = 20'000;
/// One query in so many is asked of brute force as well: FLANN's tree, itself held against brute force, judges the
/// rest.
constexpr int kBruteForceStride = 200;

/// Asks `count` random queries in and around what the camera sees, for k = 1, 10 and 16 in turns, some with a radius.
void expectSameDistances(const std::shared_ptr<const CameraModel>& camera, const DepthImage& image, int count,
                         std::mt19937& random) {
  TiledImage tiles({camera->width(), camera->height()});
  ImageIndex index(camera, tiles);
  index.build(image.pixels);
  const auto flann = buildFlannIndex(image, *camera);
  const std::vector<Vec3f> points_C = test::pointsInRange(image, *camera);
  ASSERT_EQ(index.size(), points_C.size());

  constexpr std::array<std::size_t, 3> kNeighbours = {1, 10, 16};
  constexpr std::array<float, 3> kRadii_m = {NearestPointIndex::kAnyDistance, NearestPointIndex::kAnyDistance, 1.0F};
  std::array<Neighbour, kMaxNeighbours> found;
  std::array<Neighbour, kMaxNeighbours> expected;
  const auto range_m = static_cast<float>(camera->frustum().far_m);
  std::uniform_real_distribution<float> aside(-range_m, range_m);
  std::uniform_real_distribution<float> ahead(-0.1F * range_m, 1.1F * range_m);
  for (int i = 0; i < count; ++i) {
    const Vec3f p_C(aside(random), 0.5F * aside(random), ahead(random));
    const auto turn = static_cast<std::size_t>(i);
    const std::size_t k = kNeighbours[turn % kNeighbours.size()];
    const float radius_m = kRadii_m[turn / kNeighbours.size() % kRadii_m.size()];
    const std::size_t n = index.nearest(p_C, std::span(found).first(k), radius_m);
    ASSERT_EQ(n, flann->nearest(p_C, std::span(expected).first(k), radius_m)) << p_C.transpose();
    for (std::size_t j = 0; j < n; ++j) ASSERT_EQ(found[j].distance_m, expected[j].distance_m) << p_C.transpose();
    if (i % kBruteForceStride != 0) continue;
    const std::vector<float> all_m = test::bruteForce(points_C, p_C);
    for (std::size_t j = 0; j < n; ++j) ASSERT_EQ(found[j].distance_m, all_m[j]) << p_C.transpose();
  }
}

CameraParameters sceneCamera(bool distorted) {
  CameraParameters camera = test::smallCamera(320, 240);
  camera.max_range_m = 20.0;
  if (distorted) camera.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  return camera;
}

class ImageIndexInScene : public testing::TestWithParam<std::string_view> {};

TEST_P(ImageIndexInScene, EqualsFlannAndBruteForce) {
  const simulation::Scene scene = simulation::makeScene(GetParam(), kSeed);
  const simulation::RayCaster caster(scene.mesh());
  const simulation::FlightPath path(scene, {}, kSeed);
  std::mt19937 random(kSeed);
  constexpr int kFrames = 10;
  const int queries = kQueriesOfScenes / static_cast<int>(simulation::kSceneNames.size()) / kFrames;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto camera = test::model(sceneCamera(frame % 5 == 4));
    const bool noisy = frame % 2 == 0;
    const simulation::DepthSensor sensor(
        *camera, noisy ? simulation::DepthSensorParameters{} : simulation::DepthSensorParameters::ideal(), kSeed);
    const Duration t = std::chrono::milliseconds(1000 + 700 * frame);
    const Pose T_W_C = path.at(t).T_W_B * camera->parameters().T_B_C;
    const DepthImage image = sensor.measure(caster.render(*camera, T_W_C), Time(t), static_cast<std::uint64_t>(frame));
    expectSameDistances(camera, image, queries, random);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Scene, ImageIndexInScene, testing::ValuesIn(simulation::kSceneNames),
                         [](const auto& scene) { return std::string(scene.param); });

/// Needs the recording: NANOMAP_DATA_DIR names the folder that holds kinect_office.
TEST(ImageIndexInRecording, EqualsFlannAndBruteForce) {
  const char* root = std::getenv("NANOMAP_DATA_DIR");  // NOLINT(concurrency-mt-unsafe): nobody sets it meanwhile
  const auto folder = std::filesystem::path(root != nullptr ? root : "") / "kinect_office";
  if (root == nullptr || !std::filesystem::is_directory(folder)) {
    GTEST_SKIP() << "NANOMAP_DATA_DIR names no folder with kinect_office in it.";
  }
  CameraParameters parameters = findCameraPreset("kinect-office").value();
  parameters.max_range_m = 4.0;
  const auto camera = test::model(parameters);
  std::mt19937 random(kSeed);
  constexpr std::array kFrames = {"000000", "000050", "000100", "000150", "000200"};
  for (const std::string frame : kFrames) {
    DepthPng png = readDepthPng(folder / (frame + ".depth.png"));
    DepthImage image;
    image.width_px = png.width_px;
    image.height_px = png.height_px;
    image.depth_unit_m = parameters.depth_unit_m;
    image.pixels = std::move(png.pixels);
    ASSERT_EQ(image.pixels.size(), camera->pixelCount());
    expectSameDistances(camera, image, kQueriesOfRecording / static_cast<int>(kFrames.size()), random);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace nanomap
