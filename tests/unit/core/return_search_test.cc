#include "core/return_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::paint;
using test::viewOf;

constexpr unsigned kSeed = 13;

/// Pixel by pixel.
bool scanned(const View& view, const PixelRect& rect, double limit_m, const ImageLevel& level) {
  for (int v = rect.v_min; v <= rect.v_max; ++v) {
    for (int u = rect.u_min; u <= rect.u_max; ++u) {
      const std::uint16_t raw = view.rawAt(u, v);
      if (view.camera().classify(raw) == DepthReading::kNone) continue;
      const double height_px = (u - level.through.u) * level.up.x() + (v - level.through.v) * level.up.y();
      if (static_cast<double>(view.camera().depth(raw)) <= limit_m && height_px >= -0.5) return true;
    }
  }
  return false;
}

/// Mostly far returns with a few near ones, and pixels without depth: both answers are common.
DepthImage sparseImage(const CameraModel& camera, std::mt19937& random, double near_share, double none_share) {
  DepthImage image = test::randomImage(camera, random, 7500, 9999, none_share);
  std::bernoulli_distribution near(near_share);
  std::uniform_int_distribution<int> raw(100, 7500);
  for (std::uint16_t& pixel : image.pixels) {
    if (near(random)) pixel = static_cast<std::uint16_t>(raw(random));
  }
  return image;
}

TEST(ReturnSearch, AgreesWithAScanOfEveryPixel) {
  std::mt19937 random(kSeed);
  std::array<int, 2> answers{};
  for (const auto& [width_px, height_px] : {std::pair{64, 48}, {101, 53}, {7, 5}}) {
    const auto camera = test::model(test::smallCamera(width_px, height_px));
    for (const double near_share : {0.0, 0.0005, 0.01}) {
      for (const double none_share : {0.0, 0.3, 0.99, 1.0}) {
        const ViewPtr view = viewOf(sparseImage(*camera, random, near_share, none_share), camera);
        std::uniform_int_distribution<int> column(0, width_px - 1);
        std::uniform_int_distribution<int> row(0, height_px - 1);
        std::uniform_real_distribution<double> limit_m(0.05, 8.0);
        std::uniform_real_distribution<double> angle_rad(-std::numbers::pi, std::numbers::pi);
        for (int i = 0; i < 2000; ++i) {
          const int u[] = {column(random), column(random)};
          const int v[] = {row(random), row(random)};
          const PixelRect rect{std::min(u[0], u[1]), std::max(u[0], u[1]), std::min(v[0], v[1]), std::max(v[0], v[1])};
          ImageLevel level{.through = {column(random), row(random)}};
          const double angle = angle_rad(random);
          if (i % 3 > 0) level.up = {std::cos(angle), std::sin(angle)};
          if (i % 3 > 1) level.up = {0.0, -1.0};
          const double limit = limit_m(random);
          const bool expected = scanned(*view, rect, limit, level);
          ASSERT_EQ(hasReturnWithin(*view, rect, limit, level), expected) << i;
          ++answers[expected ? 1 : 0];
        }
      }
    }
  }
  EXPECT_GT(answers[0], 5000);
  EXPECT_GT(answers[1], 5000);
}

/// The greatest raw value may be a depth like any other, and a limit may lie beyond everything.
TEST(ReturnSearch, TellsNoDepthFromTheGreatestDepth) {
  CameraParameters parameters = test::smallCamera();
  parameters.no_return_values = {0};
  const auto camera = test::model(parameters);
  const PixelRect all{0, camera->width() - 1, 0, camera->height() - 1};
  EXPECT_FALSE(hasReturnWithin(*viewOf(flatImage(*camera, 0), camera), all, 100.0, {}));
  EXPECT_TRUE(hasReturnWithin(*viewOf(flatImage(*camera, 65535), camera), all, 100.0, {}));
  EXPECT_FALSE(hasReturnWithin(*viewOf(flatImage(*camera, 65535), camera), all, 65.0, {}));
  DepthImage one = flatImage(*camera, 0);
  paint(one, 13, 13, 27, 27, 65535);
  EXPECT_TRUE(hasReturnWithin(*viewOf(one, camera), all, 100.0, {}));
}

TEST(ReturnSearch, SeesNothingOutsideItsRectangleOrBelowItsLevel) {
  const auto camera = test::model(test::smallCamera());
  DepthImage image = flatImage(*camera, 0);
  paint(image, 16, 23, 16, 23, 2000);  // one whole tile
  const ViewPtr view = viewOf(image, camera);
  EXPECT_TRUE(hasReturnWithin(*view, {23, 40, 23, 40}, 3.0, {}));
  EXPECT_FALSE(hasReturnWithin(*view, {24, 40, 16, 23}, 3.0, {}));
  EXPECT_FALSE(hasReturnWithin(*view, {0, 63, 0, 47}, 1.9, {}));
  const Eigen::Vector2d up(0.0, -1.0);
  EXPECT_TRUE(hasReturnWithin(*view, {0, 63, 0, 47}, 3.0, {.through = {40, 16}, .up = up}));
  EXPECT_FALSE(hasReturnWithin(*view, {0, 63, 0, 47}, 3.0, {.through = {40, 15}, .up = up}));
}

}  // namespace
}  // namespace nanomap
