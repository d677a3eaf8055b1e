// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_TILE_BOXES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_TILE_BOXES_INL_H_
#undef NANOMAP_CORE_TILE_BOXES_INL_H_
#else
#define NANOMAP_CORE_TILE_BOXES_INL_H_
#endif

#include <cstddef>

#include "core/box_groups.h"
#include "core/line_ranges-inl.h"
#include "core/ray_tiles.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

// Each 128-bit part of a vector of floats holds half a line of one tile, or a value of each tile in one column of the
// block.
static_assert(kLanes * sizeof(float) == hn::MaxLanes(RawTag()) * sizeof(std::uint16_t));

/// A box for each tile of a block, and the raw depths it was made from: low above high where there is nothing.
struct alignas(64) TileBoxes {
  BoxBounds bounds;
  BoxLanes raw_low;
  BoxLanes raw_high;
};

/// Four vectors, each of one tile row, folded into one: a value for each tile, column by column.
template <class Pick>
HWY_INLINE FloatVec foldTileRows(const FloatVec (&v)[kBlockEdge], Pick pick) {
  const FloatTag d;
  return fold(d, fold(d, v[0], v[2], pick), fold(d, v[1], v[3], pick), pick);
}

struct Least {
  HWY_INLINE FloatVec operator()(FloatVec a, FloatVec b) const { return hn::Min(a, b); }
};
struct Greatest {
  HWY_INLINE FloatVec operator()(FloatVec a, FloatVec b) const { return hn::Max(a, b); }
};

/// Depths along half a line of several tiles.
struct HalfLine {
  HWY_INLINE HalfLine(FloatVec least, FloatVec greatest) : raw_least(least), raw_greatest(greatest) {}

  FloatVec raw_least;
  FloatVec raw_greatest;
};

HWY_INLINE FloatVec toFloat(RawVec interleaved_with_zero) {
  return hn::ConvertTo(FloatTag(), hn::BitCast(IndexTag(), interleaved_with_zero));
}

/// Both halves of the lines of as many tiles, next to one another, as a vector holds.
struct Line {
  HWY_INLINE Line(const LineRanges::Lines& least, const LineRanges::Lines& greatest, std::size_t tile_row,
                  std::size_t first_lane)
      : Line(hn::Load(RawTag(), &least[tile_row][first_lane]), hn::Load(RawTag(), &greatest[tile_row][first_lane]),
             hn::Zero(RawTag())) {}

  HalfLine lower;
  HalfLine upper;

 private:
  HWY_INLINE Line(RawVec least, RawVec greatest, RawVec zero)
      : lower(toFloat(hn::InterleaveLower(RawTag(), least, zero)),
              toFloat(hn::InterleaveLower(RawTag(), greatest, zero))),
        upper(toFloat(hn::InterleaveUpper(RawTag(), least, zero)),
              toFloat(hn::InterleaveUpper(RawTag(), greatest, zero))) {}
};

/// Least and greatest of depth times tangent along half a line. A product of floats grows with either factor, or
/// falls, so its ends lie at the ends of both.
HWY_INLINE void spanHalfLine(const HalfLine& depths, FloatVec unit, const float* tangent_least,
                             const float* tangent_greatest, FloatVec& low, FloatVec& high) {
  const FloatTag d;
  const FloatVec near = hn::Mul(depths.raw_least, unit);
  const FloatVec far = hn::Mul(depths.raw_greatest, unit);
  const FloatVec least = hn::Load(d, tangent_least);
  const FloatVec greatest = hn::Load(d, tangent_greatest);
  const auto any = hn::Le(depths.raw_least, depths.raw_greatest);
  low = hn::IfThenElse(any, hn::Min(hn::Mul(near, least), hn::Mul(far, least)), hn::Set(d, BoxBounds::kNoBox_m));
  high =
      hn::IfThenElse(any, hn::Max(hn::Mul(near, greatest), hn::Mul(far, greatest)), hn::Set(d, -BoxBounds::kNoBox_m));
}

/// Low and high ends of x (lines are columns) or y (rows) of the tiles in one row of the block.
HWY_INLINE void spanLines(const Line& line, FloatVec unit, const TangentBounds& tangents, std::size_t place,
                          FloatVec& low, FloatVec& high) {
  FloatVec lower_low, lower_high, upper_low, upper_high;
  spanHalfLine(line.lower, unit, &tangents.least[place], &tangents.greatest[place], lower_low, lower_high);
  place += TangentBounds::kHalfRowPlaces;
  spanHalfLine(line.upper, unit, &tangents.least[place], &tangents.greatest[place], upper_low, upper_high);
  low = hn::Min(lower_low, upper_low);
  high = hn::Max(lower_high, upper_high);
}

HWY_INLINE void makeTileBoxes(const LineRanges& ranges, const TangentBounds& x, const TangentBounds& y,
                              float depth_unit_m, TileBoxes& out) {
  const FloatTag d;
  const FloatVec unit = hn::Set(d, depth_unit_m);
  for (std::size_t column = 0; column < kBlockEdge; column += kPartsOfVector) {
    FloatVec raw_low[kBlockEdge], raw_high[kBlockEdge], x_low[kBlockEdge], x_high[kBlockEdge], y_low[kBlockEdge],
        y_high[kBlockEdge];
    for (std::size_t row = 0; row < kBlockEdge; ++row) {
      const std::size_t place = row * TangentBounds::kRowPlaces + column * TangentBounds::kHalfLine;
      const Line columns(ranges.column_least, ranges.column_greatest, row, column * kEdge);
      raw_low[row] = hn::Min(columns.lower.raw_least, columns.upper.raw_least);
      raw_high[row] = hn::Max(columns.lower.raw_greatest, columns.upper.raw_greatest);
      spanLines(columns, unit, x, place, x_low[row], x_high[row]);
      const Line rows(ranges.row_least, ranges.row_greatest, row, column * kEdge);
      spanLines(rows, unit, y, place, y_low[row], y_high[row]);
    }
    const std::size_t first = column * kBlockEdge;
    const FloatVec low = foldTileRows(raw_low, Least());
    const FloatVec high = foldTileRows(raw_high, Greatest());
    hn::Store(low, d, &out.raw_low[first]);
    hn::Store(high, d, &out.raw_high[first]);
    hn::Store(foldTileRows(x_low, Least()), d, &out.bounds.low_m[0][first]);
    hn::Store(foldTileRows(x_high, Greatest()), d, &out.bounds.high_m[0][first]);
    hn::Store(foldTileRows(y_low, Least()), d, &out.bounds.low_m[1][first]);
    hn::Store(foldTileRows(y_high, Greatest()), d, &out.bounds.high_m[1][first]);
    hn::Store(hn::Mul(low, unit), d, &out.bounds.low_m[2][first]);
    hn::Store(hn::Mul(high, unit), d, &out.bounds.high_m[2][first]);
  }
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
