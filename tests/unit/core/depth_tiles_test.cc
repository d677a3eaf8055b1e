#include "core/depth_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/support/drawing.h"
#include "tests/support/instruction_sets.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::paint;

constexpr unsigned kSeed = 7;

/// @param of_columns  the greatest depth in each column of the tile, 0 without any
void expectCover(const DepthTiles::Cover& cover, const std::vector<std::uint16_t>& of_columns) {
  using Cover = DepthTiles::Cover;
  constexpr std::uint32_t kRounded = (1U << Cover::kBitsRounded) - 1;
  const std::uint32_t greatest = *std::ranges::max_element(of_columns) | kRounded;
  ASSERT_EQ(cover.greatest(), greatest);
  std::uint32_t farthest_down = 0;
  for (int column = 0; const std::uint16_t of_column : of_columns) {
    const std::uint32_t bound = cover.greatestOfColumn(column++);
    if (of_column == 0) continue;
    farthest_down = std::max(farthest_down, greatest - of_column);
    ASSERT_GE(bound, of_column);
    ASSERT_LT(bound - of_column, 1U << cover.stepShift());
  }
  ASSERT_LE(farthest_down >> cover.stepShift(), Cover::kMostSteps);
  if (cover.stepShift() > 0) {
    ASSERT_GT(farthest_down >> (cover.stepShift() - 1), Cover::kMostSteps);
  }
}

/// Tile by tile and pixel by pixel.
void expectBoundsOf(const DepthImage& image, const CameraModel& camera) {
  constexpr int kEdge = DepthTiles::kEdge_px;
  const DepthTiles tiles(image, camera);
  ASSERT_EQ(tiles.columns(), (image.width_px + kEdge - 1) / kEdge);
  ASSERT_EQ(tiles.rows(), (image.height_px + kEdge - 1) / kEdge);
  ASSERT_EQ(tiles.least().size(), tiles.tileAt(0, tiles.rows()));
  ASSERT_EQ(tiles.cover().size(), tiles.tileAt(0, tiles.rows()));
  for (int row = 0; row < tiles.rows(); ++row) {
    for (int column = 0; column < tiles.columns(); ++column) {
      const std::size_t tile = tiles.tileAt(column, row);
      std::uint16_t least = DepthTiles::kNoDepth;
      std::vector<std::uint16_t> greatest_of_columns;
      std::uint32_t lines = 0;
      std::uint32_t gap_lines = 0;
      for (int u = column * kEdge; u < std::min((column + 1) * kEdge, image.width_px); ++u) {
        const auto in_tile = static_cast<std::size_t>(u % kEdge);
        std::uint16_t greatest_of_column = 0;
        for (int v = row * kEdge; v < std::min((row + 1) * kEdge, image.height_px); ++v) {
          const std::uint16_t raw = image.pixels[static_cast<std::size_t>(v * image.width_px + u)];
          const bool none = camera.classify(raw) == DepthReading::kNone;
          least = std::min(least, none ? DepthTiles::kNoDepth : raw);
          if (!none) greatest_of_column = std::max(greatest_of_column, raw);
          lines |= DepthTiles::Cover::linesOf(u % kEdge, v % kEdge);
          if (none) gap_lines |= DepthTiles::Cover::linesOf(u % kEdge, v % kEdge);
          ASSERT_EQ((tiles.gaps()[tile][in_tile] >> (v % kEdge) & 1) != 0, none) << u << ' ' << v;
        }
        greatest_of_columns.push_back(greatest_of_column);
      }
      ASSERT_EQ(tiles.least()[tile], least) << column << ' ' << row;
      ASSERT_NO_FATAL_FAILURE(expectCover(tiles.cover()[tile], greatest_of_columns)) << column << ' ' << row;
      ASSERT_EQ(tiles.cover()[tile].gapLines() & lines, gap_lines) << column << ' ' << row;
      ASSERT_EQ(tiles.hasGap(tile), gap_lines != 0);
    }
  }
}

class DepthTilesOn : public testing::TestWithParam<std::int64_t> {
 protected:
  test::OnInstructionSet target_{GetParam()};
};

TEST_P(DepthTilesOn, BoundEveryPixelOfEverySizeOfImage) {
  std::mt19937 random(kSeed);
  for (const int width_px : {1, 7, 8, 9, 64, 101}) {
    for (const int height_px : {1, 8, 15, 48}) {
      const CameraModel camera(test::smallCamera(width_px, height_px));
      for (const double no_return_share : {0.0, 0.02, 0.9, 1.0}) {
        expectBoundsOf(test::randomImage(camera, random, 1, 65534, no_return_share), camera);
      }
    }
  }
}

TEST_P(DepthTilesOn, FollowTheCamerasOwnNoReturnValues) {
  CameraParameters parameters = test::smallCamera();
  for (const std::vector<std::uint16_t>& no_return_values :
       {std::vector<std::uint16_t>{}, {0}, {65535}, {4000}, {0, 4000, 65535}}) {
    parameters.no_return_values = no_return_values;
    const CameraModel camera(parameters);
    DepthImage image = flatImage(camera, 5000);
    paint(image, 3, 11, 3, 11, 4000);
    paint(image, 20, 20, 5, 40, 0);
    paint(image, 30, 50, 30, 47, 65535);
    expectBoundsOf(image, camera);
  }
}

INSTANTIATE_TEST_SUITE_P(Target, DepthTilesOn, testing::ValuesIn(test::instructionSets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace nanomap
