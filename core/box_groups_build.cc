#include "core/box_groups_build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/box_groups_build.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kEdge = TileGrid::kTileEdge_px;
constexpr std::size_t kBlockEdge = TileGrid::kBlockEdge_tiles;
constexpr std::size_t kBlockEdge_px = TileGrid::kBlockEdge_px;
constexpr std::size_t kBlockTiles = TileGrid::kBlockTiles;

/// A tile whose raw depths spread over more than this part of the least has two boxes, split halfway.
constexpr float kTileSpread = 0.12F;
/// A block whose boxes' depths spread over more than this part of the least has two groups, split halfway.
constexpr float kBlockSpread = 0.25F;

// Raw depths: each 128-bit part of a vector holds eight pixels of one tile.
using RawTag = hn::CappedTag<std::uint16_t, kBlockEdge_px>;
// Floats: each part holds half a line of one tile, or a value of each tile in one column of the block.
using FloatTag = hn::Repartition<float, RawTag>;
using WideTag = hn::RebindToUnsigned<FloatTag>;
using IndexTag = hn::RebindToSigned<FloatTag>;
using RawVec = hn::Vec<RawTag>;
using FloatVec = hn::Vec<FloatTag>;

constexpr std::size_t kPartsOfVector = hn::MaxLanes(RawTag()) / kEdge;
constexpr std::size_t kFloatLanes = hn::MaxLanes(FloatTag());

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

/// Least and greatest raw depth of what counts along each line of pixels of a block's tiles; 65535 and 0 of nothing.
struct alignas(64) LineRanges {
  using Lines = std::array<std::array<std::uint16_t, kBlockEdge_px>, kBlockEdge>;  ///< [tile row][tile column, line]

  Lines column_least;
  Lines column_greatest;
  Lines row_least;
  Lines row_greatest;
};

/// A box for each tile of a block, and the raw depths it was made from: low above high where there is nothing.
struct alignas(64) TileBoxes {
  BoxBounds bounds;
  BoxLanes raw_low;
  BoxLanes raw_high;
};

/// Eight rows of pixels as wide as a vector.
struct PixelRows {
  RawVec row[kEdge];
};

HWY_INLINE PixelRows loadRows(const std::uint16_t* pixels, std::size_t stride) {
  PixelRows out;
  for (std::size_t i = 0; i < kEdge; ++i) out.row[i] = hn::LoadU(RawTag(), pixels + i * stride);
  return out;
}

/// Lane by lane, both halves of each part: half as many lanes of `a`, then of `b`, in turns.
template <class Tag, class Vec, class Pick>
HWY_INLINE Vec fold(Tag tag, Vec a, Vec b, Pick pick) {
  return pick(hn::InterleaveLower(tag, a, b), hn::InterleaveUpper(tag, a, b));
}

/// The least of each column, over the rows.
HWY_INLINE RawVec leastOfColumns(const PixelRows& r) {
  return hn::Min(hn::Min(hn::Min(r.row[0], r.row[1]), hn::Min(r.row[2], r.row[3])),
                 hn::Min(hn::Min(r.row[4], r.row[5]), hn::Min(r.row[6], r.row[7])));
}

/// The least of each row, tile by tile; in the order of the rows.
HWY_INLINE RawVec leastOfRows(const PixelRows& r) {
  const auto least = [](RawVec a, RawVec b) {
    return fold(RawTag(), a, b, [](RawVec x, RawVec y) { return hn::Min(x, y); });
  };
  return least(least(least(r.row[0], r.row[4]), least(r.row[2], r.row[6])),
               least(least(r.row[1], r.row[5]), least(r.row[3], r.row[7])));
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
    above_low.row[i] = hn::Sub(rows.row[i], low);
    below_high.row[i] = hn::Sub(high, rows.row[i]);
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
  FloatVec raw_least;
  FloatVec raw_greatest;
};

HWY_INLINE FloatVec toFloat(RawVec interleaved_with_zero) {
  return hn::ConvertTo(FloatTag(), hn::BitCast(IndexTag(), interleaved_with_zero));
}

HWY_INLINE void halves(const LineRanges::Lines& least, const LineRanges::Lines& greatest, std::size_t tile_row,
                       std::size_t first_lane, HalfLine& lower, HalfLine& upper) {
  const RawTag d;
  const RawVec zero = hn::Zero(d);
  const RawVec l = hn::Load(d, &least[tile_row][first_lane]);
  const RawVec g = hn::Load(d, &greatest[tile_row][first_lane]);
  lower = {toFloat(hn::InterleaveLower(d, l, zero)), toFloat(hn::InterleaveLower(d, g, zero))};
  upper = {toFloat(hn::InterleaveUpper(d, l, zero)), toFloat(hn::InterleaveUpper(d, g, zero))};
}

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
HWY_INLINE void spanLines(const HalfLine& lower, const HalfLine& upper, FloatVec unit, const TangentBounds& tangents,
                          std::size_t place, FloatVec& low, FloatVec& high) {
  FloatVec lower_low, lower_high, upper_low, upper_high;
  spanHalfLine(lower, unit, &tangents.least[place], &tangents.greatest[place], lower_low, lower_high);
  place += TangentBounds::kHalfRowPlaces;
  spanHalfLine(upper, unit, &tangents.least[place], &tangents.greatest[place], upper_low, upper_high);
  low = hn::Min(lower_low, upper_low);
  high = hn::Max(lower_high, upper_high);
}

void makeTileBoxes(const LineRanges& ranges, const TangentBounds& x, const TangentBounds& y, float depth_unit_m,
                   TileBoxes& out) {
  const FloatTag d;
  const FloatVec unit = hn::Set(d, depth_unit_m);
  for (std::size_t column = 0; column < kBlockEdge; column += kPartsOfVector) {
    FloatVec raw_low[kBlockEdge], raw_high[kBlockEdge], x_low[kBlockEdge], x_high[kBlockEdge], y_low[kBlockEdge],
        y_high[kBlockEdge];
    for (std::size_t row = 0; row < kBlockEdge; ++row) {
      const std::size_t place = row * TangentBounds::kRowPlaces + column * TangentBounds::kHalfLine;
      HalfLine lower, upper;
      halves(ranges.column_least, ranges.column_greatest, row, column * kEdge, lower, upper);
      raw_low[row] = hn::Min(lower.raw_least, upper.raw_least);
      raw_high[row] = hn::Max(lower.raw_greatest, upper.raw_greatest);
      spanLines(lower, upper, unit, x, place, x_low[row], x_high[row]);
      halves(ranges.row_least, ranges.row_greatest, row, column * kEdge, lower, upper);
      spanLines(lower, upper, unit, y, place, y_low[row], y_high[row]);
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

/// Sets of a block's tiles, one bit each.
using TileSet = std::uint32_t;

template <class Mask>
HWY_INLINE TileSet bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};  // what StoreMaskBits may write
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return static_cast<TileSet>(bytes[0] | bytes[1] << 8);
}

HWY_INLINE hn::Mask<FloatTag> maskOf(TileSet tiles, std::size_t first) {
  const std::uint32_t lanes = tiles >> first;
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(lanes), static_cast<std::uint8_t>(lanes >> 8)};
  return hn::LoadMaskBits(FloatTag(), bytes);
}

/// The tiles for which `test(first lane)` holds.
template <class Test>
HWY_INLINE TileSet tilesWhere(Test test) {
  TileSet tiles = 0;
  for (std::size_t first = 0; first < kBlockTiles; first += kFloatLanes) tiles |= bitsOf(test(first)) << first;
  return tiles;
}

/// A block's boxes: the near, or only, one of each tile in `near_tiles`, the far one of each in `far_tiles`.
struct BlockBoxes {
  TileBoxes near;
  TileBoxes far;
  TileSet near_tiles = 0;
  TileSet far_tiles = 0;
};

struct BoxSet {
  TileSet near = 0;
  TileSet far = 0;

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(std::popcount(near)) + static_cast<std::size_t>(std::popcount(far));
  }
};

/// Writes one group at a time, and keeps the bounds of groups.
class GroupWriter {
 public:
  explicit GroupWriter(BoxGroups& out) : out_(out) { out_.count = 0; }

  void write(const BlockBoxes& boxes, BoxSet chosen, std::size_t block) {
    const std::size_t size = chosen.size();
    if (size == 0) return;
    BoxGroup& group = out_.groups[out_.count];
    BoxBounds& bounds = out_.bounds[out_.count / kGroupBoxes];
    const std::size_t lane = out_.count % kGroupBoxes;
    const FloatTag d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gather(boxes.near.bounds.low_m[axis], boxes.far.bounds.low_m[axis], chosen);
      FloatVec low = hn::Set(d, BoxBounds::kNoBox_m);
      eachVector(size, [&](std::size_t first, auto used) {
        const FloatVec v = hn::IfThenElse(used, hn::Load(d, &lanes_[first]), hn::Set(d, BoxBounds::kNoBox_m));
        low = hn::Min(low, v);
        hn::Store(v, d, &group.bounds.low_m[axis][first]);
      });
      bounds.low_m[axis][lane] = hn::GetLane(hn::MinOfLanes(d, low));

      gather(boxes.near.bounds.high_m[axis], boxes.far.bounds.high_m[axis], chosen);
      FloatVec high = hn::Set(d, -BoxBounds::kNoBox_m);
      eachVector(size, [&](std::size_t first, auto used) {
        const FloatVec v = hn::Load(d, &lanes_[first]);
        high = hn::Max(high, hn::IfThenElse(used, v, high));
        hn::Store(hn::IfThenElse(used, v, hn::Set(d, BoxBounds::kNoBox_m)), d, &group.bounds.high_m[axis][first]);
      });
      bounds.high_m[axis][lane] = hn::GetLane(hn::MaxOfLanes(d, high));
    }
    gather(boxes.near.raw_low, boxes.far.raw_low, chosen);
    storeRaw(size, group.raw_low);
    gather(boxes.near.raw_high, boxes.far.raw_high, chosen);
    storeRaw(size, group.raw_high);
    const auto first_tile = static_cast<std::uint32_t>(block * kBlockTiles);
    std::size_t box = 0;
    for (TileSet tiles : {chosen.near, chosen.far}) {
      for (; tiles != 0; tiles &= tiles - 1) {
        group.tile[box++] = first_tile + static_cast<std::uint32_t>(std::countr_zero(tiles));
      }
    }
    ++out_.count;
  }

  /// Marks what the last vector of bounds has left over.
  void finish() {
    for (std::size_t group = out_.count; group % kGroupBoxes != 0; ++group) {
      BoxBounds& bounds = out_.bounds[group / kGroupBoxes];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.low_m[axis][group % kGroupBoxes] = bounds.high_m[axis][group % kGroupBoxes] = BoxBounds::kNoBox_m;
      }
    }
  }

 private:
  /// Moves the chosen lanes to the front of lanes_.
  HWY_INLINE void gather(const BoxLanes& near, const BoxLanes& far, BoxSet chosen) {
    const FloatTag d;
    float* to = lanes_.data();
    const auto append = [&](const BoxLanes& from, TileSet tiles) {
      if (tiles == 0) return;
      for (std::size_t first = 0; first < kBlockTiles; first += kFloatLanes) {
        // Whole vectors, not CompressStore: what a masked store has written is slow to be read back.
        const auto mask = maskOf(tiles, first);
        hn::StoreU(hn::Compress(hn::Load(d, &from[first]), mask), d, to);
        to += hn::CountTrue(d, mask);
      }
    };
    append(near, chosen.near);
    append(far, chosen.far);
  }

  template <class Visit>
  HWY_INLINE static void eachVector(std::size_t size, Visit visit) {
    for (std::size_t first = 0; first < kGroupBoxes; first += kFloatLanes) {
      visit(first, hn::FirstN(FloatTag(), size > first ? size - first : 0));
    }
  }

  HWY_INLINE void storeRaw(std::size_t size, std::array<std::uint16_t, kGroupBoxes>& out) {
    const hn::Rebind<std::uint16_t, FloatTag> d16;
    for (std::size_t first = 0; first < size; first += kFloatLanes) {
      const auto wide = hn::ConvertTo(IndexTag(), hn::Load(FloatTag(), &lanes_[first]));
      hn::Store(hn::DemoteTo(d16, wide), d16, &out[first]);
    }
  }

  BoxGroups& out_;
  alignas(64) std::array<float, 2 * kGroupBoxes + kFloatLanes> lanes_{};  ///< a vector may be written past the last
};

/// Groups a block's boxes by depth, so that no group spans both a near thing and what is behind it.
void writeGroups(const BlockBoxes& boxes, std::size_t block, GroupWriter& writer) {
  const FloatTag d;
  const BoxSet all{boxes.near_tiles, boxes.far_tiles};
  const FloatVec half = hn::Set(d, 0.5F);
  const auto middle = [&](const TileBoxes& of, std::size_t first) {
    return hn::Mul(half, hn::Add(hn::Load(d, &of.raw_low[first]), hn::Load(d, &of.raw_high[first])));
  };
  FloatVec least = hn::Set(d, 65535.0F);
  FloatVec greatest = hn::Zero(d);
  for (std::size_t first = 0; first < kBlockTiles; first += kFloatLanes) {
    const auto near = maskOf(all.near, first);
    const FloatVec near_middle = middle(boxes.near, first);
    least = hn::Min(least, hn::IfThenElse(near, near_middle, least));
    greatest = hn::Max(greatest, hn::IfThenElse(near, near_middle, greatest));
    if (all.far == 0) continue;
    const auto far = maskOf(all.far, first);
    const FloatVec far_middle = middle(boxes.far, first);
    least = hn::Min(least, hn::IfThenElse(far, far_middle, least));
    greatest = hn::Max(greatest, hn::IfThenElse(far, far_middle, greatest));
  }
  const float nearest = hn::GetLane(hn::MinOfLanes(d, least));
  const float farthest = hn::GetLane(hn::MaxOfLanes(d, greatest));
  if (all.size() <= kGroupBoxes && farthest - nearest <= kBlockSpread * nearest) {
    writer.write(boxes, all, block);
    return;
  }
  const FloatVec split = hn::Set(d, 0.5F * (nearest + farthest));
  const TileSet near_behind = tilesWhere([&](std::size_t first) { return hn::Gt(middle(boxes.near, first), split); });
  const TileSet far_behind = tilesWhere([&](std::size_t first) { return hn::Gt(middle(boxes.far, first), split); });
  BoxSet before{all.near & ~near_behind, all.far & ~far_behind};
  BoxSet behind{all.near & near_behind, all.far & far_behind};
  if (before.size() > kGroupBoxes || behind.size() > kGroupBoxes) {
    before = {all.near, 0};
    behind = {0, all.far};
  }
  writer.write(boxes, before, block);
  writer.write(boxes, behind, block);
}

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
      findLineRanges(loadRows(pixels + row * kEdge * stride + lane, stride), least, greatest, row, lane, near_ranges_);
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
      const PixelRows rows = loadRows(pixels + row * kEdge * stride + lane, stride);
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
