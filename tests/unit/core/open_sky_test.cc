#include "core/open_sky.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::paint;
using test::viewOf;

constexpr unsigned kSeed = 29;
constexpr std::uint16_t kNear = 3000;  ///< counts; of a range of 10 m
constexpr std::uint16_t kFar = 9000;

Vec3 upOfRoll(double roll_rad) { return {std::sin(roll_rad), -std::cos(roll_rad), 0.0}; }

TEST(HoleAtGlance, IsNoSkyAtAnyDepth) {
  std::mt19937 random(kSeed);
  std::array<int, 2> glances{};
  for (const auto& [width_px, height_px] : {std::pair{160, 120}, {101, 53}, {20, 60}, {7, 5}}) {
    const auto camera = test::model(test::smallCamera(width_px, height_px));
    std::uniform_int_distribution<int> column(0, width_px - 1);
    std::uniform_int_distribution<int> row(0, height_px - 1);
    std::uniform_real_distribution<double> depth_m(0.2, 10.0);
    std::uniform_real_distribution<double> roll_rad(-1.5, 1.5);
    for (int i = 0; i < 500; ++i) {
      DepthImage image = flatImage(*camera, i % 2 == 0 ? 0 : kFar);
      const CameraModel::Pixel near{column(random), row(random)};
      paint(image, near.u, near.u, near.v, near.v, kNear);
      const CameraModel::Pixel gap{column(random), row(random)};
      if (gap.u == near.u && gap.v == near.v) continue;
      paint(image, gap.u, gap.u, gap.v, gap.v, 0);
      const ViewPtr view = viewOf(image, camera);
      const bool hole = isHoleAtGlance(*view, gap, {});
      ++glances[hole];
      const Vec3 up_C = upOfRoll(roll_rad(random));
      if (!hole || !liesBelowGlance(up_C)) continue;
      ASSERT_FALSE(isOpen(*view, PixelRect::of(gap), depth_m(random), up_C, {})) << i << ": " << gap.u << ' ' << gap.v;
    }
  }
  EXPECT_GT(glances[false], 100);
  EXPECT_GT(glances[true], 50);
}

/// 80 x 64 pixels: ten tiles by eight. The gap is in column 5, row 6.
class Glance : public testing::Test {
 protected:
  [[nodiscard]] bool finds(std::uint16_t raw, int u, int v, const QueryOptions& options = {}) const {
    DepthImage image = flatImage(*camera_, 0);
    paint(image, u, u, v, v, raw);
    return isHoleAtGlance(*viewOf(image, camera_), {44, 52}, options);
  }

  std::shared_ptr<const CameraModel> camera_ = test::model(test::smallCamera(80, 64));
};

TEST_F(Glance, SeesSevenTilesThreeAbove) {
  EXPECT_TRUE(finds(kNear, 44, 28));
  EXPECT_TRUE(finds(kNear, 16, 24));
  EXPECT_TRUE(finds(kNear, 71, 31));
  EXPECT_FALSE(finds(kNear, 15, 28));
  EXPECT_FALSE(finds(kNear, 72, 28));
  EXPECT_FALSE(finds(kNear, 44, 23));
  EXPECT_FALSE(finds(kNear, 44, 32));
}

TEST_F(Glance, LeavesWhatIsFarOrHasNoDepth) {
  EXPECT_FALSE(finds(kFar, 44, 28)) << "beyond 0.7 of the range";
  EXPECT_FALSE(finds(0, 44, 28));
  EXPECT_FALSE(finds(65535, 44, 28)) << "no depth either";
}

TEST_F(Glance, LeavesAllToAWindowThatItDoesNotFit) {
  EXPECT_TRUE(finds(kNear, 44, 28, {.open_window_px = 31}));
  EXPECT_FALSE(finds(kNear, 44, 28, {.open_window_px = 30}));
}

TEST_F(Glance, SeesNothingAboveTheImage) {
  DepthImage image = flatImage(*camera_, kNear);
  paint(image, 44, 44, 23, 23, 0);
  EXPECT_FALSE(isHoleAtGlance(*viewOf(image, camera_), {44, 23}, {}));
}

TEST(LiesBelowGlance, WhereTheCameraRollsLittle) {
  EXPECT_TRUE(liesBelowGlance(upOfRoll(0.0)));
  EXPECT_TRUE(liesBelowGlance(upOfRoll(0.48)));
  EXPECT_TRUE(liesBelowGlance(upOfRoll(-0.48)));
  EXPECT_FALSE(liesBelowGlance(upOfRoll(0.52)));
  EXPECT_FALSE(liesBelowGlance(upOfRoll(-0.52)));
  EXPECT_FALSE(liesBelowGlance({0.0, 1.0, 0.0})) << "upside down";
  EXPECT_FALSE(liesBelowGlance({std::nan(""), -1.0, 0.0}));
}

}  // namespace
}  // namespace nanomap
