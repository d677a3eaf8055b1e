// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_GROUP_WRITER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_GROUP_WRITER_INL_H_
#undef NANOMAP_CORE_GROUP_WRITER_INL_H_
#else
#define NANOMAP_CORE_GROUP_WRITER_INL_H_
#endif

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/box_groups.h"
#include "core/tile_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// A block whose boxes' depths spread over more than this part of the least has two groups, split halfway.
constexpr float kBlockSpread = 0.25F;

/// A group's spread is this part of its diagonal squared, divided by the number of its boxes: tests/bench/README.md has
/// how near searches begin with it.
constexpr float kSpread = 0.8F;

/// Sets of a block's tiles, one bit each.
using TileSet = std::uint32_t;

HWY_INLINE hn::Mask<FloatTag> maskOf(TileSet tiles, std::size_t first) {
  const std::uint32_t lanes = tiles >> first;
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(lanes), static_cast<std::uint8_t>(lanes >> 8)};
  return hn::LoadMaskBits(FloatTag(), bytes);
}

/// The tiles for which `test(first lane)` holds.
template <class Test>
HWY_INLINE TileSet tilesWhere(Test test) {
  TileSet tiles = 0;
  for (std::size_t first = 0; first < kBlockTiles; first += kLanes) tiles |= bitsOf(test(first)) << first;
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
    GroupBounds& of_groups = out_.bounds[out_.count / kGroupBoxes];
    BoxBounds& bounds = of_groups.boxes;
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
      bounds.low_m[axis][lane] = leastLane(low);

      gather(boxes.near.bounds.high_m[axis], boxes.far.bounds.high_m[axis], chosen);
      FloatVec high = hn::Set(d, -BoxBounds::kNoBox_m);
      eachVector(size, [&](std::size_t first, auto used) {
        const FloatVec v = hn::Load(d, &lanes_[first]);
        high = hn::Max(high, hn::IfThenElse(used, v, high));
        hn::Store(hn::IfThenElse(used, v, hn::Set(d, BoxBounds::kNoBox_m)), d, &group.bounds.high_m[axis][first]);
      });
      bounds.high_m[axis][lane] = greatestLane(high);
    }
    of_groups.spread_m2[lane] = kSpread * diagonal_m2(bounds, lane) / static_cast<float>(size);
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
      BoxBounds& bounds = out_.bounds[group / kGroupBoxes].boxes;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.low_m[axis][group % kGroupBoxes] = bounds.high_m[axis][group % kGroupBoxes] = BoxBounds::kNoBox_m;
      }
    }
  }

 private:
  static float diagonal_m2(const BoxBounds& bounds, std::size_t lane) {
    float sum_m2 = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float extent_m = bounds.high_m[axis][lane] - bounds.low_m[axis][lane];
      sum_m2 += extent_m * extent_m;
    }
    return sum_m2;
  }

  /// Moves the chosen lanes to the front of lanes_.
  HWY_INLINE void gather(const BoxLanes& near, const BoxLanes& far, BoxSet chosen) {
    const FloatTag d;
    float* to = lanes_.data();
    const auto append = [&](const BoxLanes& from, TileSet tiles) {
      if (tiles == 0) return;
      for (std::size_t first = 0; first < kBlockTiles; first += kLanes) {
        // Whole vectors, not CompressStore: what a masked store has written is slow to be read back.
        const auto mask = maskOf(tiles, first);
        hn::StoreU(chosenInFront(hn::Load(d, &from[first]), mask), d, to);
        to += hn::CountTrue(d, mask);
      }
    };
    append(near, chosen.near);
    append(far, chosen.far);
  }

  template <class Visit>
  HWY_INLINE static void eachVector(std::size_t size, Visit visit) {
    for (std::size_t first = 0; first < kGroupBoxes; first += kLanes) {
      visit(first, hn::FirstN(FloatTag(), size > first ? size - first : 0));
    }
  }

  HWY_INLINE void storeRaw(std::size_t size, std::array<std::uint16_t, kGroupBoxes>& out) {
    const hn::Rebind<std::uint16_t, FloatTag> d16;
    for (std::size_t first = 0; first < size; first += kLanes) {
      const auto wide = hn::ConvertTo(IndexTag(), hn::Load(FloatTag(), &lanes_[first]));
      hn::Store(hn::DemoteTo(d16, wide), d16, &out[first]);
    }
  }

  BoxGroups& out_;
  alignas(64) std::array<float, 2 * kGroupBoxes + kLanes> lanes_{};  ///< a vector may be written past the last
};

/// Groups a block's boxes by depth, so that no group spans both a near thing and what is behind it.
HWY_INLINE void writeGroups(const BlockBoxes& boxes, std::size_t block, GroupWriter& writer) {
  const FloatTag d;
  const BoxSet all{boxes.near_tiles, boxes.far_tiles};
  const FloatVec half = hn::Set(d, 0.5F);
  const auto middle = [&](const TileBoxes& of, std::size_t first) {
    return hn::Mul(half, hn::Add(hn::Load(d, &of.raw_low[first]), hn::Load(d, &of.raw_high[first])));
  };
  FloatVec least = hn::Set(d, 65535.0F);
  FloatVec greatest = hn::Zero(d);
  for (std::size_t first = 0; first < kBlockTiles; first += kLanes) {
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
  const float nearest = leastLane(least);
  const float farthest = greatestLane(greatest);
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

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
