#include "core/depth_tiles.h"

#include <algorithm>
#include <span>

namespace nanomap {
namespace {

int tilesAlong(int pixels) { return (pixels + DepthTiles::kEdge_px - 1) / DepthTiles::kEdge_px; }

}  // namespace

DepthTiles::DepthTiles(const DepthImage& image, const CameraModel& camera)
    : columns_(tilesAlong(image.width_px)), rows_(tilesAlong(image.height_px)) {
  constexpr auto kEdge = static_cast<std::size_t>(kEdge_px);
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  const std::span<const std::uint16_t> no_return = camera.parameters().no_return_values;
  least_.reserve(tileAt(0, rows_));
  greatest_.reserve(tileAt(0, rows_));

  // Column by column over a row of tiles, in loops without a branch that the compiler turns into vector code.
  std::vector<std::uint16_t> depths(width);
  std::vector<std::uint16_t> least(width);
  std::vector<std::uint16_t> greatest(width);
  for (std::size_t top = 0; top < height; top += kEdge) {
    std::fill(least.begin(), least.end(), kNoDepth);
    std::fill(greatest.begin(), greatest.end(), std::uint16_t{0});
    for (std::size_t v = top; v < std::min(top + kEdge, height); ++v) {
      const auto row = std::span(image.pixels).subspan(v * width, width);
      std::copy(row.begin(), row.end(), depths.begin());
      for (const std::uint16_t value : no_return) {
        for (std::size_t u = 0; u < width; ++u) depths[u] = row[u] == value ? kNoDepth : depths[u];
      }
      for (std::size_t u = 0; u < width; ++u) {
        least[u] = std::min(least[u], depths[u]);
        greatest[u] = std::max(greatest[u], depths[u]);
      }
    }
    for (std::size_t left = 0; left < width; left += kEdge) {
      const std::size_t count = std::min(kEdge, width - left);
      least_.push_back(std::ranges::min(std::span(least).subspan(left, count)));
      greatest_.push_back(std::ranges::max(std::span(greatest).subspan(left, count)));
    }
  }
}

}  // namespace nanomap
