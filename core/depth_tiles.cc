#include "core/depth_tiles.h"

#include <algorithm>
#include <array>
#include <span>

namespace nanomap {
namespace {

int tilesAlong(int pixels) { return (pixels + DepthTiles::kEdge_px - 1) / DepthTiles::kEdge_px; }

}  // namespace

DepthTiles::DepthTiles(const CameraModel& camera)
    : columns_(tilesAlong(camera.width())),
      rows_(tilesAlong(camera.height())),
      least_(tileAt(0, rows_), kNoDepth),
      greatest_(tileAt(0, rows_), 0),
      cover_(tileAt(0, rows_), kNoDepth),
      gaps_(tileAt(0, rows_)) {
  Gaps everywhere;
  everywhere.fill(0xFF);
  std::fill(gaps_.begin(), gaps_.end(), everywhere);
}

void DepthTiles::assign(const DepthImage& image, const CameraModel& camera) {
  constexpr auto kEdge = static_cast<std::size_t>(kEdge_px);
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  const std::span<const std::uint16_t> no_return = camera.parameters().no_return_values;

  // Column by column over a row of tiles, a strip of columns at a time, in loops without a branch that the compiler
  // turns into vector code.
  constexpr std::size_t kStrip = 64;
  using Strip = std::array<std::uint16_t, kStrip>;
  std::size_t tile = 0;
  for (std::size_t top = 0; top < height; top += kEdge) {
    for (std::size_t left = 0; left < width; left += kStrip) {
      const std::size_t columns = std::min(kStrip, width - left);
      Strip least;
      Strip greatest{};
      Strip gaps{};
      least.fill(kNoDepth);
      for (std::size_t v = top; v < std::min(top + kEdge, height); ++v) {
        Strip raw{};
        std::copy_n(&image.pixels[v * width + left], columns, raw.begin());
        Strip gap{};
        for (const std::uint16_t value : no_return) {
          for (std::size_t u = 0; u < kStrip; ++u) gap[u] = raw[u] == value ? kNoDepth : gap[u];
        }
        const auto row_bit = static_cast<std::uint16_t>(1U << (v - top));
        for (std::size_t u = 0; u < kStrip; ++u) {
          const auto depth_or_zero = static_cast<std::uint16_t>(raw[u] & ~gap[u]);
          least[u] = std::min(least[u], static_cast<std::uint16_t>(depth_or_zero | gap[u]));
          greatest[u] = std::max(greatest[u], depth_or_zero);
          gaps[u] = static_cast<std::uint16_t>(gaps[u] | (gap[u] & row_bit));
        }
      }
      for (std::size_t first = 0; first < columns; first += kEdge, ++tile) {
        const std::size_t count = std::min(kEdge, columns - first);
        least_[tile] = std::ranges::min(std::span(least).subspan(first, count));
        greatest_[tile] = std::ranges::max(std::span(greatest).subspan(first, count));
        std::uint32_t any_gap = 0;
        for (std::size_t u = 0; u < count; ++u) {
          gaps_[tile][u] = static_cast<std::uint8_t>(gaps[first + u]);
          any_gap |= gaps[first + u];
        }
        cover_[tile] = any_gap == 0 ? greatest_[tile] : kNoDepth;
      }
    }
  }
}

}  // namespace nanomap
