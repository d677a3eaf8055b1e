#include "core/box_groups_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>

#include "core/nearest_point_index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/box_groups_search.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on
#include "core/lanes-inl.h"
#include "core/near_order-inl.h"
#include "core/nearest_many-inl.h"
#include "core/nearest_one-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Boxes that may hold something near enough, with how near that can be at best.
class Candidates {
 public:
  /// The boxes numbered from `first_box` on in the lanes that are chosen. @pre none are kept of more than one group
  HWY_INLINE void add(std::size_t first_box, FloatVec least_sq_m2, hn::Mask<FloatTag> chosen) {
    size_ = addAt(size_, first_box, least_sq_m2, chosen);
  }

  /// The boxes within reach of one group after the other, as long as there is room.
  /// @param distanceAt  least squared distances of a group's boxes from a lane on
  /// @return how many groups that was; all of them, or one at least if none were kept of more than one group
  template <class DistanceAt>
  HWY_INLINE std::size_t addGroups(std::span<const std::int32_t> groups, FloatVec reach_sq_m2, DistanceAt distanceAt) {
    std::size_t size = size_;  // a copy, which nothing that is stored meanwhile can change
    std::size_t added = 0;
    for (; added < groups.size() && size + kGroupBoxes <= kCapacity; ++added) {
      const auto group = static_cast<std::size_t>(groups[added]);
      for (std::size_t lane = 0; lane < kGroupBoxes; lane += kLanes) {
        const FloatVec distance = distanceAt(group, lane);
        size = addAt(size, group * kGroupBoxes + lane, distance, hn::Le(distance, reach_sq_m2));
      }
    }
    size_ = size;
    return added;
  }

  /// Visits what is within reach when its turn comes, nearest first at the beginning; none is left.
  template <class Reach, class Visit>
  HWY_INLINE void visitAll(Reach reach_sq_m2, Visit visit) {
    // Then reach has come down to where finding the next takes longer than visiting one too many.
    constexpr int kVisitedInOrder = 6;
    const IndexTag di;
    for (std::size_t i = 0; i < Order::kStep; i += kLanes)
      hn::StoreU(hn::Set(di, Order::kAfterAll), di, &keys_[size_ + i]);
    Order::Key next = Order::next(keys_.data(), size_, Order::kBeforeAll);
    for (int i = 0; i < kVisitedInOrder && Order::bound(next) <= reach_sq_m2(); ++i) {
      // What comes after it is found first, else that would wait for the visit.
      const std::size_t place = Order::place(next);
      next = Order::next(keys_.data(), size_, next);
      visit(static_cast<std::size_t>(boxes_[place]));
    }
    if (Order::bound(next) <= reach_sq_m2()) {
      const IndexVec first = hn::Set(di, next);
      const IndexVec last = hn::Set(di, Order::lastWithin(reach_sq_m2()));
      for (std::size_t step = 0; step < size_; step += Order::kStep) {
        std::uint32_t left = 0;
        for (std::size_t i = 0; i < Order::kStep; i += kLanes) {
          const IndexVec keys = hn::Load(di, &keys_[step + i]);
          const auto is_left = hn::Not(hn::Or(hn::Lt(keys, first), hn::Gt(keys, last)));
          left |= bitsOf(hn::RebindMask(FloatTag(), is_left)) << i;
        }
        for (; left != 0; left &= left - 1) {
          visit(static_cast<std::size_t>(boxes_[step + static_cast<std::size_t>(std::countr_zero(left))]));
        }
      }
    }
    size_ = 0;
  }

 private:
  static constexpr std::size_t kCapacity = 256;
  using Order = NearOrder<kCapacity>;

  /// @return the size after it
  HWY_INLINE std::size_t addAt(std::size_t size, std::size_t first_box, FloatVec least_sq_m2,
                               hn::Mask<FloatTag> chosen) {
    const IndexTag di;
    // Whole vectors, not CompressStore: what a masked store has written is slow to be read back.
    hn::StoreU(Order::keysOf(chosenInFront(least_sq_m2, chosen), countingFrom(size)), di, &keys_[size]);
    hn::StoreU(chosenInFront(countingFrom(first_box), hn::RebindMask(di, chosen)), di, &boxes_[size]);
    return size + hn::CountTrue(FloatTag(), chosen);
  }

  // Whole steps are written past the last.
  using Column = std::array<std::int32_t, kCapacity + Order::kStep>;
  alignas(64) Column keys_;
  alignas(64) Column boxes_;
  std::size_t size_ = 0;
};

/// Branch and bound from one point: groups, their boxes, the pixels of the tiles.
/// Bounds need no slack for rounding: clamping to a box is exact, and rounded differences, squares and sums grow with
/// what they are made of, so that no pixel computes as nearer than its box.
template <class Nearest>
class Search {
 public:
  HWY_INLINE Search(const IndexedImage& indexed, const Vec3f& p_C, Nearest& nearest)
      : indexed_(indexed),
        x_(hn::Set(FloatTag(), p_C.x())),
        y_(hn::Set(FloatTag(), p_C.y())),
        z_(hn::Set(FloatTag(), p_C.z())),
        nearest_(nearest) {}

  HWY_INLINE void run() {
    // As many groups at a time as distances are kept of: all of them, unless the image is very large.
    for (std::size_t first = 0; first < indexed_.boxes.count; first += kSweep) {
      sweep(first, std::min(first + kSweep, indexed_.boxes.count));
    }
  }

 private:
  static constexpr std::size_t kSweep = 2048;
  static constexpr auto kStep = static_cast<std::int32_t>(kLanes);
  using GroupOrder = NearOrder<kSweep>;
  using BoxOrder = NearOrder<kGroupBoxes>;

  HWY_INLINE FloatVec leastDistance(const BoxBounds& boxes, std::size_t lane) const {
    const FloatTag d;
    const auto along = [&](FloatVec p, std::size_t axis) {
      const FloatVec clamped =
          hn::Min(hn::Max(p, hn::Load(d, &boxes.low_m[axis][lane])), hn::Load(d, &boxes.high_m[axis][lane]));
      const FloatVec difference = hn::Sub(p, clamped);
      return hn::Mul(difference, difference);
    };
    return hn::Add(hn::Add(along(x_, 0), along(y_, 1)), along(z_, 2));
  }

  HWY_INLINE void sweep(std::size_t first, std::size_t end) {
    const FloatTag d;
    const IndexTag di;
    alignas(64) std::array<float, kSweep> least_sq_m2;
    IndexVec keys = hn::Set(di, GroupOrder::kAfterAll);
    IndexVec places = countingFrom(0);
    for (std::size_t group = first; group < end; group += kLanes, places = hn::Add(places, hn::Set(di, kStep))) {
      const GroupBounds& bounds = indexed_.boxes.bounds[group / kGroupBoxes];
      const FloatVec distance = leastDistance(bounds.boxes, group % kGroupBoxes);
      const FloatVec spread = hn::Load(d, &bounds.spread_m2[group % kGroupBoxes]);
      hn::Store(distance, d, &least_sq_m2[group - first]);
      keys = hn::Min(keys, GroupOrder::keysOf(hn::Add(distance, spread), places));
    }

    // The nearest boxes of one group bring the reach down before any other is opened: not of the group that begins
    // nearest, which may be all but empty there, but of the one that is likely to hold something near.
    const std::size_t likely = GroupOrder::place(leastLane(keys));
    if (least_sq_m2[likely] <= nearest_.reach()) {
      least_sq_m2[likely] = kInfinity;
      openLikely(first + likely);
    }

    const FloatVec reach = hn::Set(d, nearest_.reach());
    alignas(64) std::array<std::int32_t, kSweep + kGroupBoxes> near;
    std::size_t near_count = 0;
    places = countingFrom(first);
    for (std::size_t i = 0; i < end - first; i += kLanes, places = hn::Add(places, hn::Set(di, kStep))) {
      const auto chosen = hn::RebindMask(di, hn::Le(hn::Load(d, &least_sq_m2[i]), reach));
      hn::StoreU(chosenInFront(places, chosen), di, &near[near_count]);
      near_count += hn::CountTrue(di, chosen);
    }
    open(std::span(near).first(near_count));
  }

  /// Visits the nearest boxes of a group, and adds the others within reach to the candidates.
  HWY_INLINE void openLikely(std::size_t group) {
    // The second one brings the reach down by more than it costs; a third one does not.
    constexpr std::size_t kVisitedFirst = 2;
    static_assert(kVisitedFirst <= Nearest::kCollected);
    const FloatTag d;
    const IndexTag di;
    alignas(64) BoxLanes least_sq_m2;
    alignas(64) std::array<BoxOrder::Key, kGroupBoxes> keys;
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec distance = leastDistance(indexed_.boxes.groups[group].bounds, i);
      hn::Store(distance, d, &least_sq_m2[i]);
      hn::Store(BoxOrder::keysOf(distance, countingFrom(i)), di, &keys[i]);
    }
    // By the reach as it was before, so that they need not wait for one another.
    const float reach_before = nearest_.reach();
    BoxOrder::Key next = BoxOrder::next(keys.data(), keys.size(), BoxOrder::kBeforeAll);
    for (std::size_t i = 0; i < kVisitedFirst && BoxOrder::bound(next) <= reach_before; ++i) {
      const std::size_t place = BoxOrder::place(next);
      next = BoxOrder::next(keys.data(), keys.size(), next);
      visit<Added::kTogether>(group * kGroupBoxes + place);
    }
    nearest_.addCollected();
    const FloatVec reach = hn::Set(d, nearest_.reach());
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec distance = hn::Load(d, &least_sq_m2[i]);
      const auto left = hn::RebindMask(d, hn::Not(hn::Lt(hn::Load(di, &keys[i]), hn::Set(di, next))));
      candidates_.add(group * kGroupBoxes + i, distance, hn::And(hn::Le(distance, reach), left));
    }
  }

  /// Visits the boxes of groups that are within reach, and the candidates there are.
  HWY_INLINE void open(std::span<const std::int32_t> groups) {
    do {
      const FloatVec reach = hn::Set(FloatTag(), nearest_.reach());
      const std::size_t opened = candidates_.addGroups(groups, reach, [this](std::size_t group, std::size_t lane) {
        return leastDistance(indexed_.boxes.groups[group].bounds, lane);
      });
      groups = groups.subspan(opened);
      candidates_.visitAll([this] { return nearest_.reach(); },
                           [this](std::size_t box) { visit<Added::kAtOnce>(box); });
    } while (!groups.empty());
  }

  enum class Added {
    kAtOnce,
    kTogether,  ///< with others, by addCollected()
  };

  /// Looks at the pixels of a box, given by number: those of its tile with its raw depths.
  template <Added kAdded>
  HWY_INLINE void visit(std::size_t box) {
    const FloatTag d;
    const IndexTag di;
    const BoxGroup& group = indexed_.boxes.groups[box / kGroupBoxes];
    const std::size_t lane = box % kGroupBoxes;
    const std::uint32_t tile = group.tile[lane];
    const PixelTile& pixels = indexed_.image.tiles()[tile];
    const TangentTile& x = indexed_.rays.x(tile);
    const TangentTile& y = indexed_.rays.y(tile);
    const FloatVec unit = hn::Set(d, indexed_.depth_unit_m);
    const FloatVec p_x = x_;  // copies, which nothing that is stored meanwhile can change
    const FloatVec p_y = y_;
    const FloatVec p_z = z_;
    const std::span<const std::uint16_t> excluded = indexed_.in_range.excluded;
    const IndexVec below = hn::Set(di, group.raw_low[lane] - 1);
    const IndexVec above = hn::Set(di, group.raw_high[lane] + 1);
    const auto distanceAt = [&](std::size_t i) {
      const IndexVec raw = hn::PromoteTo(di, hn::Load(hn::Rebind<std::uint16_t, FloatTag>(), &pixels.raw[i]));
      auto counts = hn::And(hn::Gt(raw, below), hn::Lt(raw, above));
      for (const std::uint16_t value : excluded) counts = hn::AndNot(hn::Eq(raw, hn::Set(di, value)), counts);
      const FloatVec z = hn::Mul(hn::ConvertTo(d, raw), unit);
      const FloatVec dx = hn::Sub(p_x, hn::Mul(hn::Load(d, &x.tangents[i]), z));
      const FloatVec dy = hn::Sub(p_y, hn::Mul(hn::Load(d, &y.tangents[i]), z));
      const FloatVec dz = hn::Sub(p_z, z);
      const FloatVec sq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      return hn::IfThenElse(hn::RebindMask(d, counts), sq, hn::Set(d, kInfinity));
    };
    const std::uint32_t first_pixel = tile * static_cast<std::uint32_t>(TileGrid::kTilePixels);
    if constexpr (kAdded == Added::kAtOnce) {
      nearest_.addTile(first_pixel, distanceAt);
    } else {
      nearest_.collectTile(first_pixel, distanceAt);
    }
  }

  const IndexedImage& indexed_;
  FloatVec x_;
  FloatVec y_;
  FloatVec z_;
  Nearest& nearest_;
  Candidates candidates_;
};

std::size_t find(const IndexedImage& indexed, const Vec3f& p_C, float limit_sq_m2, std::span<FoundPixel> out) {
  if (out.size() == 1) {
    NearestOne nearest(limit_sq_m2);
    Search(indexed, p_C, nearest).run();
    return nearest.copyTo(out);
  }
  NearestMany nearest(limit_sq_m2, out.size());
  Search(indexed, p_C, nearest).run();
  return nearest.copyTo(out);
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(find);

std::size_t findNearest(const IndexedImage& indexed, const Vec3f& p_C, float limit_sq_m2, std::span<FoundPixel> out) {
  assert(!out.empty() && out.size() <= kMaxNeighbours);
  return HWY_DYNAMIC_DISPATCH(find)(indexed, p_C, limit_sq_m2, out);
}

}  // namespace nanomap
#endif
