// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_LINE_RANGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_LINE_RANGES_INL_H_
#undef NANOMAP_CORE_LINE_RANGES_INL_H_
#else
#define NANOMAP_CORE_LINE_RANGES_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/lanes-inl.h"
#include "core/tile_grid.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

constexpr std::size_t kEdge = TileGrid::kTileEdge_px;
constexpr std::size_t kBlockEdge = TileGrid::kBlockEdge_tiles;
constexpr std::size_t kBlockEdge_px = TileGrid::kBlockEdge_px;
constexpr std::size_t kBlockTiles = TileGrid::kBlockTiles;

// Raw depths: each 128-bit part of a vector holds eight pixels of one tile.
using RawTag = hn::CappedTag<std::uint16_t, kBlockEdge_px>;
using RawVec = hn::Vec<RawTag>;
constexpr std::size_t kPartsOfVector = hn::MaxLanes(RawTag()) / kEdge;

/// Least and greatest raw depth of what counts along each line of pixels of a block's tiles; 65535 and 0 of nothing.
struct alignas(64) LineRanges {
  using Lines = std::array<std::array<std::uint16_t, kBlockEdge_px>, kBlockEdge>;  ///< [tile row][tile column, line]

  Lines column_least;
  Lines column_greatest;
  Lines row_least;
  Lines row_greatest;
};

/// Eight rows of pixels as wide as a vector.
using PixelRows = RawVec[kEdge];

HWY_INLINE void loadRows(const std::uint16_t* pixels, std::size_t stride, PixelRows& out) {
  for (std::size_t i = 0; i < kEdge; ++i) out[i] = hn::LoadU(RawTag(), pixels + i * stride);
}

/// Lane by lane, both halves of each part: half as many lanes of `a`, then of `b`, in turns.
template <class Tag, class Vec, class Pick>
HWY_INLINE Vec fold(Tag tag, Vec a, Vec b, Pick pick) {
  return pick(hn::InterleaveLower(tag, a, b), hn::InterleaveUpper(tag, a, b));
}

/// The least of each column, over the rows.
HWY_INLINE RawVec leastOfColumns(const PixelRows& r) {
  return hn::Min(hn::Min(hn::Min(r[0], r[1]), hn::Min(r[2], r[3])), hn::Min(hn::Min(r[4], r[5]), hn::Min(r[6], r[7])));
}

/// The least of each row, tile by tile; in the order of the rows.
HWY_INLINE RawVec leastOfRows(const PixelRows& r) {
  const auto least = [](RawVec a, RawVec b) {
    return fold(RawTag(), a, b, [](RawVec x, RawVec y) { return hn::Min(x, y); });
  };
  return least(least(least(r[0], r[4]), least(r[2], r[6])), least(least(r[1], r[5]), least(r[3], r[7])));
}

/// Ranges of the lines of as many tiles, next to one another, as a vector holds.
HWY_INLINE void findLineRanges(const PixelRows& rows, RawVec low, RawVec high, std::size_t tile_row,
                               std::size_t first_lane, LineRanges& out) {
  // Counted upwards from `low`, and downwards from `high`, modulo 65536, whatever does not count lies above `span`: so
  // minima alone tell both ends, and whether there is anything.
  const RawVec span = hn::Sub(high, low);
  PixelRows above_low;
  PixelRows below_high;
  for (std::size_t i = 0; i < kEdge; ++i) {
    above_low[i] = hn::Sub(rows[i], low);
    below_high[i] = hn::Sub(high, rows[i]);
  }
  const RawVec nothing = hn::Set(RawTag(), 65535);
  const auto store = [&](RawVec least_above, RawVec least_below, LineRanges::Lines& least,
                         LineRanges::Lines& greatest) {
    const auto any = hn::Eq(hn::Min(least_above, span), least_above);
    hn::Store(hn::IfThenElse(any, hn::Add(low, least_above), nothing), RawTag(), &least[tile_row][first_lane]);
    hn::Store(hn::IfThenElseZero(any, hn::Sub(high, least_below)), RawTag(), &greatest[tile_row][first_lane]);
  };
  store(leastOfColumns(above_low), leastOfColumns(below_high), out.column_least, out.column_greatest);
  store(leastOfRows(above_low), leastOfRows(below_high), out.row_least, out.row_greatest);
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
