#include "core/view_scan.h"

#include <bit>

#include "core/depth_tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/view_scan.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on
#include "core/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

static_assert(kViewLanes == kGroupBoxes, "views fill the vectors that boxes do");
using Float = FloatTag;
using Int = IndexTag;
using IntVec = IndexVec;
using Mask = hn::Mask<Float>;

/// Relative to the width or height of an image [cells]: above all rounding that does not come from the mean's position.
constexpr float kCellRounding = 0x1p-20F;
/// A mean whose depth is less than this many slacks has no certain cell.
constexpr float kLeastDepthInSlacks = 16.0F;
/// Above every raw value that is a depth for certain.
constexpr float kGreatestCertainRaw = static_cast<float>(DepthTiles::kNoDepth - 1);
constexpr int kTileShift = 3;
static_assert(1 << kTileShift == DepthTiles::kEdge_px);
constexpr auto kFirstColumn = static_cast<std::int32_t>(DepthTiles::Cover::kFirstColumn);
constexpr auto kFirstRow = static_cast<std::int32_t>(DepthTiles::Cover::kFirstRow);

/// DepthTiles::Cover of the lanes of a vector.
struct CoverLanes {
  alignas(64) std::array<std::int32_t, kViewLanes> bits;
  alignas(64) std::array<std::int32_t, kViewLanes> steps;
};

/// Covers of neighbouring lanes, the bits and the steps of one after those of the other.
template <class D>
HWY_INLINE hn::Vec<D> interleavedCovers(D d, const DepthTiles::Cover* const* covers, const std::int32_t* tiles) {
  if constexpr (hn::MaxLanes(D()) == 2) {
    return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(covers[0] + tiles[0]));
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kOfHalf = hn::MaxLanes(half) / 2;
    return hn::Combine(d, interleavedCovers(half, covers + kOfHalf, tiles + kOfHalf),
                       interleavedCovers(half, covers, tiles));
  }
}

/// Covers of the lanes of a vector, from `first` on. A call, so that tiles are read from memory: inlined, the compiler
/// takes them out of a vector one by one.
HWY_NOINLINE void loadCovers(const ViewLanes& views, std::size_t first, const ProbedLanes& at, CoverLanes& out) {
  const Int di;
  constexpr std::size_t kOfHalf = hn::MaxLanes(Int()) / 2;
  const auto* covers = views.cover.data() + first;
  const auto* tiles = at.tile.data() + first;
  const IntVec left = interleavedCovers(di, covers, tiles);
  const IntVec right = interleavedCovers(di, covers + kOfHalf, tiles + kOfHalf);
  hn::Store(hn::ConcatEven(di, right, left), di, out.bits.data());
  hn::Store(hn::ConcatOdd(di, right, left), di, out.steps.data());
}

/// One point against one vector of views: the lanes of `views` from `first` on. Bits are relative to `first`.
/// Vectors are never members: those of some targets have no size.
class VectorProbe {
 public:
  VectorProbe(const ViewLanes& views, std::size_t first, const PointProbe& probe)
      : views_(views), first_(first), probe_(probe) {}

  static std::size_t laneCount() { return hn::Lanes(Float()); }

  HWY_INLINE void run(ProbedLanes& out) const {
    const Float d;
    const FloatVec zero = hn::Zero(d);
    const FloatVec slack = hn::Set(d, probe_.slack_m);
    const FloatVec z = coordinate(2);
    const FloatVec beyond_near = hn::Add(hn::Sub(z, load(views_.near_m)), slack);
    const FloatVec before_far = hn::Add(hn::Sub(load(views_.far_m), z), slack);
    const FloatVec in_range = hn::Min(beyond_near, before_far);
    if (hn::AllFalse(d, hn::Ge(in_range, zero))) return;

    // Distances from the side planes, times the length of their normals (1, tangent), and the slack.
    const FloatVec x = coordinate(0);
    const FloatVec y = coordinate(1);
    const FloatVec from_left = hn::Add(hn::NegMulAdd(load(views_.tan_left), z, x), slack);
    const FloatVec from_right = hn::Add(hn::MulSub(load(views_.tan_right), z, x), slack);
    const FloatVec from_top = hn::Add(hn::NegMulAdd(load(views_.tan_top), z, y), slack);
    const FloatVec from_bottom = hn::Add(hn::MulSub(load(views_.tan_bottom), z, y), slack);
    const FloatVec in_sides = hn::Min(hn::Min(from_left, from_right), hn::Min(from_top, from_bottom));
    if (hn::AllFalse(d, hn::Ge(hn::Min(in_range, in_sides), zero))) return;

    // Occlusion first: it rules out most and costs least.
    const std::uint32_t inside = bitsOf(hn::Ge(hn::Min(in_range, in_sides), zero));
    const Cells cells = findCells(z, from_left, from_top, inside, out);
    const std::uint32_t visible = inside & ~behindTiles(cells, inside, out);
    if (visible == 0) return;

    const FloatVec half_x = leastHalfSize(0);
    const FloatVec half_y = leastHalfSize(1);
    const FloatVec half_z = leastHalfSize(2);
    const Mask contained =
        hn::And(hn::And(hn::Ge(in_range, half_z), hn::Ge(from_left, support(half_x, half_z, views_.tan_left))),
                hn::And(hn::Ge(from_right, support(half_x, half_z, views_.tan_right)),
                        hn::And(hn::Ge(from_top, support(half_y, half_z, views_.tan_top)),
                                hn::Ge(from_bottom, support(half_y, half_z, views_.tan_bottom)))));
    out.left |= (visible & bitsOf(contained)) << first_;
  }

 private:
  /// The lines of a tile that the mean can fall in, as bits of a cover, and the lanes where there is but one tile.
  struct Cells {
    IntVec columns;
    IntVec rows;
    hn::Mask<Int> one_column;
    std::uint32_t in_tile;
  };

  /// Where the mean falls: the least cell that it can fall in, the raw depth that it is not nearer than, and the lanes
  /// where no other cell is possible.
  HWY_INLINE Cells findCells(FloatVec z, FloatVec from_left, FloatVec from_top, std::uint32_t inside,
                             ProbedLanes& out) const {
    const Float d;
    const Int di;
    const FloatVec slack = hn::Set(d, probe_.slack_m);
    const Mask deep = hn::Ge(z, hn::Set(d, kLeastDepthInSlacks * probe_.slack_m));
    const FloatVec per_m = hn::Div(hn::Set(d, 1.0F), hn::IfThenElse(deep, z, hn::Set(d, 1.0F)));
    const FloatVec columns_per_m = hn::Mul(load(views_.cells_per_tan_x), per_m);
    const FloatVec rows_per_m = hn::Mul(load(views_.cells_per_tan_y), per_m);
    const FloatVec last_column = load(views_.last_column);
    const FloatVec last_row = load(views_.last_row);
    const IntVec column = toCell(leastCell(from_left, columns_per_m, last_column), last_column);
    const IntVec row = toCell(leastCell(from_top, rows_per_m, last_row), last_row);
    const IntVec max_column = toCell(greatestCell(from_left, columns_per_m, last_column), last_column);
    const IntVec max_row = toCell(greatestCell(from_top, rows_per_m, last_row), last_row);
    hn::Store(column, di, out.column.data() + first_);
    hn::Store(row, di, out.row.data() + first_);
    const IntVec other = hn::Or(hn::Xor(column, max_column), hn::Xor(row, max_row));
    out.in_cell |= (inside & bitsOf(hn::And(deep, hn::RebindMask(d, hn::Eq(other, hn::Zero(di)))))) << first_;

    const FloatVec raw = hn::Mul(hn::Sub(z, slack), load(views_.counts_per_m));
    const FloatVec certain_raw = hn::Min(hn::Max(raw, hn::Zero(d)), hn::Set(d, kGreatestCertainRaw));
    hn::Store(hn::ConvertTo(di, certain_raw), di, out.raw.data() + first_);

    const auto one_tile = hn::Lt(other, hn::Set(di, DepthTiles::kEdge_px));
    const IntVec tile_row = hn::ShiftRight<kTileShift>(row);
    const IntVec tile_columns = hn::Load(di, views_.tile_columns.data() + first_);
    const IntVec tile = hn::Add(hn::Mul(tile_row, tile_columns), hn::ShiftRight<kTileShift>(column));
    hn::Store(tile, di, out.tile.data() + first_);
    return {lines(kFirstColumn, column, max_column), lines(kFirstRow, row, max_row), hn::Eq(column, max_column),
            bitsOf(hn::And(deep, hn::RebindMask(d, one_tile)))};
  }

  /// The bits of a cover's columns or rows from one to another.
  /// @pre no more of them than a tile has, and the first not behind the last in a tile; else any bits
  static HWY_INLINE IntVec lines(std::int32_t first_line, IntVec from, IntVec to) {
    const Int di;
    const IntVec in_tile = hn::Set(di, DepthTiles::kEdge_px - 1);
    const IntVec behind = hn::Shl(hn::Set(di, 2 * first_line), hn::And(to, in_tile));
    return hn::Sub(behind, hn::Shl(hn::Set(di, first_line), hn::And(from, in_tile)));
  }

  /// Bits of the lanes where the pixel of every cell that the mean can fall in carries a depth for certain, and the
  /// mean is not nearer than any depth of its tile, or of its column there.
  HWY_INLINE std::uint32_t behindTiles(const Cells& cells, std::uint32_t inside, const ProbedLanes& out) const {
    const Float d;
    const Int di;
    CoverLanes covers;
    loadCovers(views_, first_, out, covers);
    const IntVec bits_of_cover = hn::Load(di, covers.bits.data());
    const IntVec none = hn::Zero(di);
    const auto may_be_gap =
        hn::And(hn::Ne(hn::And(bits_of_cover, cells.columns), none), hn::Ne(hn::And(bits_of_cover, cells.rows), none));
    const IntVec raw = hn::Load(di, out.raw.data() + first_);
    const IntVec column = hn::Load(di, out.column.data() + first_);
    const IntVec steps = hn::Load(di, covers.steps.data());
    const IntVec down = hn::IfThenElseZero(cells.one_column, below(bits_of_cover, steps, column));
    const auto nearer = hn::Lt(raw, hn::Sub(greatest(bits_of_cover), down));
    return inside & views_.tiled >> first_ & cells.in_tile & ~bitsOf(hn::RebindMask(d, hn::Or(may_be_gap, nearer)));
  }

  /// DepthTiles::Cover::greatest().
  static HWY_INLINE IntVec greatest(IntVec bits_of_cover) {
    constexpr int kRounded = DepthTiles::Cover::kBitsRounded;
    constexpr std::int32_t kRoundedUp = (1 << kRounded) - 1;
    constexpr std::int32_t kOfBits = ((1 << DepthTiles::Cover::kDepthBits) - 1) << kRounded;
    const Int di;
    return hn::Or(hn::And(hn::ShiftLeft<kRounded>(bits_of_cover), hn::Set(di, kOfBits)), hn::Set(di, kRoundedUp));
  }

  /// By how much DepthTiles::Cover::greatestOfColumn() is below that.
  static HWY_INLINE IntVec below(IntVec bits_of_cover, IntVec steps, IntVec column) {
    using Cover = DepthTiles::Cover;
    const Int di;
    const IntVec in_tile = hn::And(column, hn::Set(di, DepthTiles::kEdge_px - 1));
    const IntVec place = hn::Mul(in_tile, hn::Set(di, Cover::kBitsOfColumn));
    const IntVec count = hn::And(hn::Shr(steps, place), hn::Set(di, static_cast<std::int32_t>(Cover::kMostSteps)));
    const IntVec shift =
        hn::And(hn::ShiftRight<Cover::kDepthBits>(bits_of_cover), hn::Set(di, (1 << Cover::kStepBits) - 1));
    return hn::Shl(count, shift);
  }

  HWY_INLINE FloatVec load(const ViewLanes::Floats& lanes) const { return hn::Load(Float(), lanes.data() + first_); }

  /// Of the mean, in the cameras' frames.
  HWY_INLINE FloatVec coordinate(std::size_t axis) const {
    const Float d;
    const auto& row = views_.R_C_B[axis];
    const FloatVec along_z = hn::MulAdd(load(row[2]), hn::Set(d, probe_.mean_B_m[2]), load(views_.t_C_B_m[axis]));
    const FloatVec along_yz = hn::MulAdd(load(row[1]), hn::Set(d, probe_.mean_B_m[1]), along_z);
    return hn::MulAdd(load(row[0]), hn::Set(d, probe_.mean_B_m[0]), along_yz);
  }

  HWY_INLINE FloatVec leastHalfSize(std::size_t axis) const {
    const Float d;
    const auto& row = views_.R_C_B[axis];
    const FloatVec variance =
        hn::Add(load(views_.edge_variance_C_m2[axis]), rotatedVariance(load(row[0]), load(row[1]), load(row[2])));
    const FloatVec deviation = hn::Sqrt(hn::Max(hn::Sub(variance, hn::Set(d, probe_.slack_m2)), hn::Zero(d)));
    return hn::Add(deviation, hn::Set(d, probe_.margin_m));
  }

  /// r^T Sigma r, with r = (a, b, c).
  HWY_INLINE FloatVec rotatedVariance(FloatVec a, FloatVec b, FloatVec c) const {
    const Float d;
    const auto& s = probe_.covariance_B_m2;
    const FloatVec xy = hn::Set(d, s[3]);
    const FloatVec xz = hn::Set(d, s[4]);
    const FloatVec yz = hn::Set(d, s[5]);
    const FloatVec from_x = hn::MulAdd(a, hn::Set(d, s[0]), hn::MulAdd(b, xy, hn::Mul(c, xz)));
    const FloatVec from_y = hn::MulAdd(a, xy, hn::MulAdd(b, hn::Set(d, s[1]), hn::Mul(c, yz)));
    const FloatVec from_z = hn::MulAdd(a, xz, hn::MulAdd(b, yz, hn::Mul(c, hn::Set(d, s[2]))));
    return hn::MulAdd(a, from_x, hn::MulAdd(b, from_y, hn::Mul(c, from_z)));
  }

  /// Of the box, in the direction of a side plane's normal (1, tangent).
  HWY_INLINE FloatVec support(FloatVec half_size, FloatVec half_z, const ViewLanes::Floats& tangent) const {
    return hn::MulAdd(hn::Abs(load(tangent)), half_z, half_size);
  }

  /// `slacked_m` is the distance from the first plane plus the slack.
  HWY_INLINE FloatVec greatestCell(FloatVec slacked_m, FloatVec cells_per_m, FloatVec last) const {
    return hn::MulAdd(hn::Add(last, hn::Set(Float(), 1.0F)), hn::Set(Float(), kCellRounding),
                      hn::Mul(cells_per_m, slacked_m));
  }
  HWY_INLINE FloatVec leastCell(FloatVec slacked_m, FloatVec cells_per_m, FloatVec last) const {
    const FloatVec twice_slack = hn::Set(Float(), 2.0F * probe_.slack_m);
    return hn::NegMulAdd(hn::Add(last, hn::Set(Float(), 1.0F)), hn::Set(Float(), kCellRounding),
                         hn::Mul(cells_per_m, hn::Sub(slacked_m, twice_slack)));
  }
  /// Always a cell of the image, whatever the lane holds.
  HWY_INLINE IntVec toCell(FloatVec cell, FloatVec last) const {
    return hn::ConvertTo(Int(), hn::Min(hn::Max(cell, hn::Zero(Float())), last));
  }

  const ViewLanes& views_;
  std::size_t first_;
  const PointProbe& probe_;
};

/// BlockLanes's bound on `plane`, in the blocks from `first` on.
HWY_INLINE FloatVec greatestInside(const BlockLanes::Plane& plane, std::size_t first, const PointProbe& probe) {
  const Float d;
  FloatVec inside_m = hn::Load(d, plane.offset_m.data() + first);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const FloatVec p_B = hn::Set(d, probe.mean_B_m[axis]);
    inside_m = hn::MulAdd(hn::Load(d, plane.normal_B[axis].data() + first), p_B, inside_m);
    inside_m = hn::MulAdd(hn::Load(d, plane.spread_B[axis].data() + first), hn::Abs(p_B), inside_m);
  }
  return inside_m;
}

/// Bits of the blocks that the mean may be in the frustum of a view of.
std::uint32_t blocksAround(const BlockLanes& group, const PointProbe& probe) {
  const Float d;
  std::uint32_t around = 0;
  for (std::size_t first = 0; first < kViewLanes; first += VectorProbe::laneCount()) {
    FloatVec inside_m = greatestInside(group.planes[0], first, probe);
    for (std::size_t i = 1; i < BlockLanes::kPlanes; ++i) {
      inside_m = hn::Min(inside_m, greatestInside(group.planes[i], first, probe));
    }
    around |= bitsOf(hn::Ge(inside_m, hn::Set(d, -probe.slack_m))) << first;
  }
  return around;
}

bool scan(std::span<const BlockLanes> groups, std::span<const ViewLanes> blocks, const PointProbe& probe,
          ProbedLanes& out) {
  for (;;) {
    while (out.blocks_ahead == 0) {
      if (out.groups_entered == groups.size()) return false;
      out.blocks_ahead = blocksAround(groups[out.groups_entered++], probe);
    }
    const auto in_group = static_cast<std::size_t>(std::countr_zero(out.blocks_ahead));
    out.blocks_ahead &= out.blocks_ahead - 1;
    out.block = (out.groups_entered - 1) * kViewLanes + in_group;
    out.left = 0;
    out.in_cell = 0;
    for (std::size_t first = 0; first < kViewLanes; first += VectorProbe::laneCount()) {
      VectorProbe(blocks[out.block], first, probe).run(out);
    }
    if (out.left != 0) return true;
  }
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(scan);

bool scanViews(std::span<const BlockLanes> groups, std::span<const ViewLanes> blocks, const PointProbe& probe,
               ProbedLanes& out) {
  return HWY_DYNAMIC_DISPATCH(scan)(groups, blocks, probe, out);
}

}  // namespace nanomap
#endif
