#include "drivers/mavlink/obstacle_distance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using ::testing::Each;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint16_t kUnknown = ObstacleDistances::kUnknown;
constexpr std::size_t kAhead = 0;
constexpr std::size_t kRight30 = 6;
constexpr std::size_t kLeft30 = 66;

/// 90 degrees wide, 0.2 .. 10 m, at the body's origin.
std::shared_ptr<const CameraModel> camera() { return test::model(test::smallCamera(128, 96)); }

ObstacleDistances distancesOf(const DepthImage& image, const Pose& T_L_B = {}) {
  const auto view = test::viewOf(image, camera());
  return obstacleDistances(*view, T_L_B * view->camera().parameters().T_B_C, ObstacleBand{}, QueryOptions{});
}

/// A wall across the view, seen by a level camera.
DepthImage wall(std::uint16_t depth_mm) { return test::flatImage(*camera(), depth_mm); }

TEST(ObstacleDistance, OfAWallIsItsHorizontalDistance) {
  const ObstacleDistances distances = distancesOf(wall(4000));
  EXPECT_EQ(distances.min_distance_cm, 20);
  EXPECT_EQ(distances.max_distance_cm, 1000);
  EXPECT_NEAR(distances.cells_cm[kAhead], 400, 1);
  // The nearest point within the cell, whose edge lies 27.5 degrees off.
  EXPECT_NEAR(distances.cells_cm[kRight30], 400 / std::cos(27.5 * kDegree), 2);
  EXPECT_NEAR(distances.cells_cm[kLeft30], 400 / std::cos(27.5 * kDegree), 2);
  EXPECT_EQ(distances.cells_cm[36], kUnknown);  // behind
  EXPECT_EQ(distances.cells_cm[12], kUnknown);  // 60 degrees to the right
}

TEST(ObstacleDistance, CountsClockwise) {
  DepthImage image = wall(0);
  test::paint(image, 96, 105, 44, 52, 5000);  // right of the middle
  const ObstacleDistances distances = distancesOf(image);
  EXPECT_NEAR(distances.cells_cm[kRight30], 500 / std::cos(27.5 * kDegree), 10);
  EXPECT_EQ(distances.cells_cm[kLeft30], distances.clear());  // sky
}

TEST(ObstacleDistance, AgreesWithEveryPixel) {
  std::mt19937 random(11);
  const auto model = camera();
  for (int round = 0; round < 20; ++round) {
    const DepthImage image = test::randomImage(*model, random, 1000, 12'000, 0.5);
    const Pose T_L_B{Quat(Eigen::AngleAxisd(0.02 * round, Vec3::UnitY())), Vec3::Zero()};
    const ObstacleDistances distances = distancesOf(image, T_L_B);
    // The oracle: in degrees, cell by cell.
    for (std::size_t cell = 0; cell < ObstacleDistances::kCells; ++cell) {
      double nearest_m = 1e9;
      for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
        if (model->classify(image.pixels[pixel]) != DepthReading::kInRange) continue;
        const Vec3 p_L =
            T_L_B * (model->parameters().T_B_C * model->deproject(pixel, image.pixels[pixel]).cast<double>());
        const double clockwise_deg = std::fmod(360.0 - std::atan2(p_L.y(), p_L.x()) / kDegree, 360.0);
        const double off_deg = std::remainder(clockwise_deg - 5.0 * static_cast<double>(cell), 360.0);
        if (std::abs(off_deg) < 2.5 && std::abs(p_L.z()) < 0.5)
          nearest_m = std::min(nearest_m, std::hypot(p_L.x(), p_L.y()));
      }
      if (nearest_m < 9.99) {
        EXPECT_NEAR(distances.cells_cm[cell], nearest_m * 100.0, 1.0) << cell;
      } else {
        EXPECT_GE(distances.cells_cm[cell], distances.max_distance_cm) << cell;
      }
    }
  }
}

TEST(ObstacleDistance, OfTheGroundIsNone) {
  // Level flight 2 m above the ground: pixels below the horizon see it at 2 m / tan(pitch).
  const auto model = camera();
  DepthImage image = wall(20'000);  // beyond the range: seen through
  for (int v = 0; v < image.height_px; ++v) {
    const double tan_down = (v - model->parameters().cy_px) / model->parameters().fy_px;
    if (tan_down < 0.11) continue;
    test::paint(image, 0, image.width_px - 1, v, v, static_cast<std::uint16_t>(2000.0 / tan_down));
  }
  const ObstacleDistances distances = distancesOf(image);
  EXPECT_EQ(distances.cells_cm[kAhead], distances.clear());
  EXPECT_EQ(distances.clear(), 1001);
}

TEST(ObstacleDistance, IsLevelForAPitchedBody) {
  // Braking, nose up by 20 degrees: what lies on the optical axis is high above.
  const Pose T_L_B{Quat(Eigen::AngleAxisd(-20.0 * kDegree, Vec3::UnitY())), Vec3::Zero()};
  DepthImage image = wall(20'000);
  test::paint(image, 60, 67, 44, 51, 4000);
  EXPECT_NE(distancesOf(image).cells_cm[kAhead], distancesOf(image).clear());
  const ObstacleDistances pitched = distancesOf(image, T_L_B);
  EXPECT_EQ(pitched.cells_cm[kAhead], pitched.clear());
}

TEST(ObstacleDistance, OfWhatIsTooNearIsTouching) {
  DepthImage image = wall(4000);
  test::paint(image, 60, 67, 44, 51, 150);
  EXPECT_EQ(distancesOf(image).cells_cm[kAhead], ObstacleDistances::kTouching);
  EXPECT_NEAR(distancesOf(image).cells_cm[kRight30], 450, 10);
}

TEST(ObstacleDistance, OfSkyIsClearAndOfAHoleUnknown) {
  const ObstacleDistances sky = distancesOf(wall(0));
  EXPECT_EQ(sky.cells_cm[kAhead], sky.clear());
  DepthImage image = wall(0);
  test::paint(image, 0, image.width_px - 1, 0, 30, 3000);  // a lintel: what is below it is a pane, not sky
  EXPECT_EQ(distancesOf(image).cells_cm[kAhead], kUnknown);
}

TEST(ObstacleDistance, OfASnapshotIsInTheLevelFrameOfItsBody) {
  ChainSnapshot snapshot;
  snapshot.stamp = Time(std::chrono::seconds(3));
  const ObstacleDistances nothing = obstacleDistances(snapshot, ObstacleBand{}, QueryOptions{});
  EXPECT_EQ(nothing.stamp, snapshot.stamp);
  EXPECT_THAT(nothing.cells_cm, Each(kUnknown));

  // Seen straight ahead; since then the body has turned left by 30 degrees and flown 1 m ahead as it was.
  snapshot.T_W_B = {
      Quat(Eigen::AngleAxisd(30.0 * kDegree, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX())),
      Vec3(1.0, 0.0, 0.0)};
  DepthImage image = wall(20'000);
  test::paint(image, 62, 65, 46, 49, 5000);
  const auto view = test::viewOf(image, camera());
  const Pose T_C_B = view->camera().parameters().T_B_C.inverse() * snapshot.T_W_B;
  snapshot.views.push_back({view, T_C_B.rotation.toRotationMatrix(), T_C_B.translation_m, Mat3::Zero(), Vec3::UnitZ()});
  const ObstacleDistances distances = obstacleDistances(snapshot, ObstacleBand{}, QueryOptions{});
  EXPECT_EQ(distances.stamp, view->stamp());
  EXPECT_NEAR(distances.cells_cm[kRight30], 400, 2);
}

}  // namespace
}  // namespace nanomap
