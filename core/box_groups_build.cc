#include "core/box_groups_build.h"

#include <algorithm>
#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/box_groups_build.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on
#include "core/group_writer-inl.h"
#include "core/line_ranges-inl.h"
#include "core/tile_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// A tile whose raw depths spread over more than this part of the least has two boxes, split halfway.
constexpr float kTileSpread = 0.12F;
/// Which raw depths count, tile by tile, each repeated for a tile's eight columns.
struct alignas(64) RawIntervals {
  std::array<std::array<std::uint16_t, kBlockEdge_px>, kBlockEdge> low;  ///< [tile row][column of pixels]
  std::array<std::array<std::uint16_t, kBlockEdge_px>, kBlockEdge> high;

  void set(std::size_t tile, std::uint16_t tile_low, std::uint16_t tile_high) {
    const std::size_t row = tile % kBlockEdge;
    const std::size_t first = tile / kBlockEdge * kEdge;
    std::fill_n(low[row].begin() + first, kEdge, tile_low);
    std::fill_n(high[row].begin() + first, kEdge, tile_high);
  }
};

class Builder {
 public:
  Builder(std::span<const std::uint16_t> pixels, const RayTiles& rays, const RawRange& in_range, float depth_unit_m,
          TiledImage& image, BoxGroups& out)
      : pixels_(pixels), rays_(rays), in_range_(in_range), unit_m_(depth_unit_m), image_(image), writer_(out) {}

  void run() {
    const TileGrid& grid = image_.grid();
    for (int row = 0; row < grid.blockRows(); ++row) {
      for (int column = 0; column < grid.blockColumns(); ++column) {
        image_.assignBlock(pixels_, column, row);
        if (!in_range_.empty()) addBlock(column, row);
      }
    }
    writer_.finish();
  }

 private:
  void addBlock(int block_column, int block_row) {
    const TileGrid& grid = image_.grid();
    const auto left = static_cast<std::size_t>(block_column) * kBlockEdge_px;
    const auto top = static_cast<std::size_t>(block_row) * kBlockEdge_px;
    const auto width = static_cast<std::size_t>(grid.width_px);
    const auto height = static_cast<std::size_t>(grid.height_px);
    const std::uint16_t* pixels = &pixels_[top * width + left];
    std::size_t stride = width;
    if (left + kBlockEdge_px > width || top + kBlockEdge_px > height) {
      copyOverBorder(left, top);
      pixels = border_.data();
      stride = kBlockEdge_px;
    }
    const std::size_t block = grid.blockAt(block_column, block_row);
    const TangentBounds& x = rays_.xBounds(block);
    const TangentBounds& y = rays_.yBounds(block);

    const RawTag d;
    const RawVec least = hn::Set(d, in_range_.least);
    const RawVec greatest = hn::Set(d, in_range_.greatest);
    eachBatch([&](std::size_t row, std::size_t lane) {
      PixelRows rows;
      loadRows(pixels + row * kEdge * stride + lane, stride, rows);
      findLineRanges(rows, least, greatest, row, lane, near_ranges_);
    });
    makeTileBoxes(near_ranges_, x, y, unit_m_, boxes_.near);

    const FloatTag df;
    const TileSet inside = tilesInside(width - left, height - top);
    boxes_.near_tiles =
        inside & tilesWhere([&](std::size_t first) {
          return hn::Le(hn::Load(df, &boxes_.near.raw_low[first]), hn::Load(df, &boxes_.near.raw_high[first]));
        });
    if (boxes_.near_tiles == 0) return;
    boxes_.far_tiles = boxes_.near_tiles & tilesWhere([&](std::size_t first) {
                         const FloatVec low = hn::Load(df, &boxes_.near.raw_low[first]);
                         const FloatVec high = hn::Load(df, &boxes_.near.raw_high[first]);
                         return hn::Gt(hn::Sub(high, low), hn::Mul(hn::Set(df, kTileSpread), low));
                       });
    if (boxes_.far_tiles != 0) splitMixedTiles(pixels, stride, x, y);
    writeGroups(boxes_, block, writer_);
  }

  /// Gives the tiles of mixed depth their near and far boxes.
  void splitMixedTiles(const std::uint16_t* pixels, std::size_t stride, const TangentBounds& x,
                       const TangentBounds& y) {
    for (std::size_t tile = 0; tile < kBlockTiles; ++tile) {
      if ((boxes_.far_tiles >> tile & 1U) == 0) {
        near_intervals_.set(tile, in_range_.least, in_range_.greatest);
        far_intervals_.set(tile, in_range_.least, in_range_.greatest);  // not used
        continue;
      }
      const auto low = static_cast<unsigned>(boxes_.near.raw_low[tile]);
      const auto high = static_cast<unsigned>(boxes_.near.raw_high[tile]);
      const unsigned split = (low + high) / 2;
      near_intervals_.set(tile, static_cast<std::uint16_t>(low), static_cast<std::uint16_t>(split));
      far_intervals_.set(tile, static_cast<std::uint16_t>(split + 1), static_cast<std::uint16_t>(high));
    }
    const RawTag d;
    eachBatch([&](std::size_t row, std::size_t lane) {
      PixelRows rows;
      loadRows(pixels + row * kEdge * stride + lane, stride, rows);
      findLineRanges(rows, hn::Load(d, &near_intervals_.low[row][lane]), hn::Load(d, &near_intervals_.high[row][lane]),
                     row, lane, near_ranges_);
      findLineRanges(rows, hn::Load(d, &far_intervals_.low[row][lane]), hn::Load(d, &far_intervals_.high[row][lane]),
                     row, lane, far_ranges_);
    });
    makeTileBoxes(near_ranges_, x, y, unit_m_, boxes_.near);
    makeTileBoxes(far_ranges_, x, y, unit_m_, boxes_.far);
  }

  template <class Visit>
  HWY_INLINE static void eachBatch(Visit visit) {
    for (std::size_t row = 0; row < kBlockEdge; ++row) {
      for (std::size_t lane = 0; lane < kBlockEdge_px; lane += kPartsOfVector * kEdge) visit(row, lane);
    }
  }

  /// The block's pixels; beyond the border the nearest one inside, which moves no bound.
  void copyOverBorder(std::size_t left, std::size_t top) {
    const auto width = static_cast<std::size_t>(image_.grid().width_px);
    const auto height = static_cast<std::size_t>(image_.grid().height_px);
    for (std::size_t v = 0; v < kBlockEdge_px; ++v) {
      const std::uint16_t* row = &pixels_[std::min(top + v, height - 1) * width];
      for (std::size_t u = 0; u < kBlockEdge_px; ++u) {
        border_[v * kBlockEdge_px + u] = row[std::min(left + u, width - 1)];
      }
    }
  }

  static TileSet tilesInside(std::size_t width, std::size_t height) {
    TileSet tiles = 0;
    for (std::size_t tile = 0; tile < kBlockTiles; ++tile) {
      const bool inside = tile / kBlockEdge * kEdge < width && tile % kBlockEdge * kEdge < height;
      tiles |= static_cast<TileSet>(inside) << tile;
    }
    return tiles;
  }

  std::span<const std::uint16_t> pixels_;
  const RayTiles& rays_;
  const RawRange& in_range_;
  float unit_m_;
  TiledImage& image_;
  GroupWriter writer_;
  BlockBoxes boxes_;
  LineRanges near_ranges_;
  LineRanges far_ranges_;
  RawIntervals near_intervals_;
  RawIntervals far_intervals_;
  alignas(64) std::array<std::uint16_t, kBlockEdge_px * kBlockEdge_px> border_;
};

void build(std::span<const std::uint16_t> pixels, const RayTiles& rays, const RawRange& in_range, float depth_unit_m,
           TiledImage& image, BoxGroups& boxes) {
  Builder(pixels, rays, in_range, depth_unit_m, image, boxes).run();
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(build);

void buildBoxGroups(std::span<const std::uint16_t> pixels, const RayTiles& rays, const RawRange& in_range,
                    float depth_unit_m, TiledImage& image, BoxGroups& boxes) {
  HWY_DYNAMIC_DISPATCH(build)(pixels, rays, in_range, depth_unit_m, image, boxes);
}

}  // namespace nanomap
#endif
