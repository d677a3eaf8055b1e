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

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kGroupBoxes>;
using IndexTag = hn::RebindToSigned<FloatTag>;
using RawTag = hn::Rebind<std::uint16_t, FloatTag>;
using FloatVec = hn::Vec<FloatTag>;
using IndexVec = hn::Vec<IndexTag>;

constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());
constexpr std::size_t kTilePixels = TileGrid::kTilePixels;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Lanes of a group of boxes, one bit each.
template <class Mask>
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};  // what StoreMaskBits may write
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
}

HWY_INLINE float leastLane(FloatVec v) { return hn::GetLane(hn::MinOfLanes(FloatTag(), v)); }

alignas(64) constexpr std::array<std::int32_t, kGroupBoxes> kCounting = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                         8, 9, 10, 11, 12, 13, 14, 15};

/// first, first + 1, ...
HWY_INLINE IndexVec countingFrom(std::size_t first) {
  const IndexTag di;
  return hn::Add(hn::Load(di, kCounting.data()), hn::Set(di, static_cast<std::int32_t>(first)));
}

/// Which of up to `kPlaces` distances is least, near enough: the low bits of a distance make room for its place, so
/// that one minimum finds both.
template <std::int32_t kPlaces>
class LeastPlace {
  static_assert((kPlaces & (kPlaces - 1)) == 0);

 public:
  HWY_INLINE LeastPlace() : keys_(hn::Set(IndexTag(), std::numeric_limits<std::int32_t>::max())) {}

  /// @param distance_sq_m2  of the places from `first` on
  HWY_INLINE void add(FloatVec distance_sq_m2, std::size_t first) {
    const IndexTag di;
    const IndexVec rounded = hn::And(hn::BitCast(di, distance_sq_m2), hn::Set(di, ~(kPlaces - 1)));
    keys_ = hn::Min(keys_, hn::Or(rounded, countingFrom(first)));
  }

  /// At most the least distance added, and less by a few bits.
  [[nodiscard]] HWY_INLINE float bound() const { return std::bit_cast<float>(leastKey() & ~(kPlaces - 1)); }
  [[nodiscard]] HWY_INLINE std::size_t place() const { return static_cast<std::size_t>(leastKey() & (kPlaces - 1)); }

 private:
  [[nodiscard]] HWY_INLINE std::int32_t leastKey() const { return hn::GetLane(hn::MinOfLanes(IndexTag(), keys_)); }

  IndexVec keys_;
};

/// Boxes that may hold something near enough, with how near that can be at best.
class Candidates {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// The boxes of a group in the lanes from `first` on that are in `chosen`. @pre there is room for a vector
  HWY_INLINE void append(const BoxGroup& group, std::size_t first, FloatVec least_sq_m2, hn::Mask<FloatTag> chosen) {
    const FloatTag d;
    const IndexTag di;
    const IndexVec raw_low = hn::PromoteTo(di, hn::Load(RawTag(), &group.raw_low[first]));
    const IndexVec raw_high = hn::PromoteTo(di, hn::Load(RawTag(), &group.raw_high[first]));
    const IndexVec raw = hn::Or(raw_low, hn::ShiftLeft<16>(raw_high));
    const FloatVec tile = hn::BitCast(d, hn::Load(hn::RebindToUnsigned<FloatTag>(), &group.tile[first]));
    // Whole vectors, not CompressStore: what a masked store has written is slow to be read back.
    hn::StoreU(hn::Compress(tile, chosen), d, tiles_.data() + size_);
    hn::StoreU(hn::Compress(hn::BitCast(d, raw), chosen), d, raw_.data() + size_);
    hn::StoreU(hn::Compress(least_sq_m2, chosen), d, least_sq_m2_.data() + size_);
    size_ += hn::CountTrue(d, chosen);
  }

  [[nodiscard]] bool hasRoomForGroup() const { return size_ + kGroupBoxes <= kCapacity; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Visits the nearest, if it is within reach, and takes it out of consideration.
  template <class Visit>
  HWY_INLINE void visitNearest(float reach_sq_m2, Visit visit) {
    const FloatTag d;
    hn::StoreU(hn::Set(d, kInfinity), d, &least_sq_m2_[size_]);
    LeastPlace<kCapacity> nearest;
    for (std::size_t i = 0; i < size_; i += kLanes) nearest.add(hn::Load(d, &least_sq_m2_[i]), i);
    if (!(nearest.bound() <= reach_sq_m2)) return;
    const std::size_t i = nearest.place();
    least_sq_m2_[i] = kInfinity;
    visitAt(i, visit);
  }

  /// Visits, in no order, what is within reach when its turn comes; none is left.
  template <class Reach, class Visit>
  HWY_INLINE void visitAll(Reach reach_sq_m2, Visit visit) {
    const FloatTag d;
    hn::StoreU(hn::Set(d, kInfinity), d, &least_sq_m2_[size_]);
    for (std::size_t first = 0; first < size_; first += kLanes) {
      std::uint32_t near = bitsOf(hn::Le(hn::Load(d, &least_sq_m2_[first]), hn::Set(d, reach_sq_m2())));
      for (; near != 0; near &= near - 1) {
        const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(near));
        if (least_sq_m2_[i] <= reach_sq_m2()) visitAt(i, visit);
      }
    }
    size_ = 0;
  }

 private:
  template <class Visit>
  HWY_INLINE void visitAt(std::size_t i, Visit visit) {
    const auto raw = std::bit_cast<std::uint32_t>(raw_[i]);
    visit(std::bit_cast<std::uint32_t>(tiles_[i]), static_cast<std::int32_t>(raw & 0xFFFFU),
          static_cast<std::int32_t>(raw >> 16));
  }

  // A vector may be written past the last. All columns hold bits of floats, whatever they mean.
  using Column = std::array<float, kCapacity + kGroupBoxes>;
  alignas(64) Column least_sq_m2_;
  alignas(64) Column tiles_;
  alignas(64) Column raw_;  ///< raw_low, and raw_high above it
  std::size_t size_ = 0;
};

/// Squared distances of a tile's pixels, infinite where a pixel does not count.
struct alignas(64) TileDistances {
  std::array<float, kTilePixels> sq_m2;

  [[nodiscard]] HWY_INLINE FloatVec vector(std::size_t first) const { return hn::Load(FloatTag(), &sq_m2[first]); }

  /// The pixels within `limit`, one bit each.
  [[nodiscard]] HWY_INLINE std::uint64_t within(float limit_sq_m2) const {
    const FloatVec limit = hn::Set(FloatTag(), limit_sq_m2);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
      bits |= static_cast<std::uint64_t>(bitsOf(hn::Le(vector(i), limit))) << i;
    }
    return bits;
  }
};

/// The nearest pixel. Lanes keep a nearest one each, so that one tile need not wait for what the last one gave; the
/// reach follows a few tiles later.
class NearestOne {
 public:
  HWY_INLINE explicit NearestOne(float limit_sq_m2)
      : distance_sq_m2_(hn::Set(FloatTag(), limit_sq_m2)),
        pixel_(hn::Set(IndexTag(), kNoPixel)),
        reach_sq_m2_(limit_sq_m2) {}

  /// Nothing farther can be the nearest; at this distance a pixel with a lower number can.
  [[nodiscard]] float reach() const { return reach_sq_m2_; }

  HWY_INLINE void refreshReach() { reach_sq_m2_ = leastLane(distance_sq_m2_); }

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void addTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    const FloatTag d;
    const IndexTag di;
    for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
      const FloatVec distance = distanceAt(i);
      const IndexVec pixel = countingFrom(first_pixel + i);
      const auto equal_and_before =
          hn::And(hn::Eq(distance, distance_sq_m2_), hn::RebindMask(d, hn::Lt(pixel, pixel_)));
      const auto better = hn::Or(hn::Lt(distance, distance_sq_m2_), equal_and_before);
      distance_sq_m2_ = hn::IfThenElse(better, distance, distance_sq_m2_);
      pixel_ = hn::IfThenElse(hn::RebindMask(di, better), pixel, pixel_);
    }
    constexpr unsigned kTilesPerRefresh = 4;
    if (++tiles_ % kTilesPerRefresh == 0) refreshReach();
  }

  std::size_t copyTo(std::span<FoundPixel> out) const {
    const float least = leastLane(distance_sq_m2_);
    const auto at_least = hn::RebindMask(IndexTag(), hn::Eq(distance_sq_m2_, hn::Set(FloatTag(), least)));
    const IndexVec pixels = hn::IfThenElse(at_least, pixel_, hn::Set(IndexTag(), kNoPixel));
    const std::int32_t pixel = hn::GetLane(hn::MinOfLanes(IndexTag(), pixels));
    if (pixel == kNoPixel) return 0;
    out[0] = {least, static_cast<std::uint32_t>(pixel)};
    return 1;
  }

 private:
  static constexpr std::int32_t kNoPixel = std::numeric_limits<std::int32_t>::max();

  FloatVec distance_sq_m2_;
  IndexVec pixel_;
  float reach_sq_m2_;
  unsigned tiles_ = 0;
};

/// The k nearest pixels for any k up to kMaxNeighbours.
class NearestMany {
 public:
  NearestMany(float limit_sq_m2, std::size_t k) : k_(k) { keys_.fill(keyOf(limit_sq_m2, kNoPixel)); }

  [[nodiscard]] float reach() const { return distanceOf(keys_[k_ - 1]); }

  void refreshReach() {}  // always fresh

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void addTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    const FloatTag d;
    TileDistances distances;
    FloatVec least = hn::Set(d, kInfinity);
    for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
      const FloatVec distance = distanceAt(i);
      hn::Store(distance, d, &distances.sq_m2[i]);
      least = hn::Min(least, distance);
    }
    if (hn::AllFalse(d, hn::Le(least, hn::Set(d, reach())))) return;
    std::uint64_t places = distances.within(reach());
    if (static_cast<std::size_t>(std::popcount(places)) > k_) places &= distances.within(kthOfLanes(distances));
    for (; places != 0; places &= places - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(places));
      insert(keyOf(distances.sq_m2[place], first_pixel + static_cast<std::uint32_t>(place)));
    }
  }

  std::size_t copyTo(std::span<FoundPixel> out) const {
    std::size_t count = 0;
    while (count < k_ && pixelOf(keys_[count]) != kNoPixel) {
      out[count] = {distanceOf(keys_[count]), pixelOf(keys_[count])};
      ++count;
    }
    return count;
  }

 private:
  /// Orders as distance, then pixel: bits of floats that are not negative order as the floats do.
  using Key = std::uint64_t;
  static constexpr std::uint32_t kNoPixel = std::numeric_limits<std::uint32_t>::max();

  static Key keyOf(float distance_sq_m2, std::uint32_t pixel) {
    return Key{std::bit_cast<std::uint32_t>(distance_sq_m2)} << 32 | pixel;
  }
  static float distanceOf(Key key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }
  static std::uint32_t pixelOf(Key key) { return static_cast<std::uint32_t>(key); }

  HWY_INLINE void insert(Key key) {
    if (key >= keys_[k_ - 1]) return;
    std::size_t i = k_ - 1;
    for (; i > 0 && keys_[i - 1] > key; --i) keys_[i] = keys_[i - 1];
    keys_[i] = key;
  }

  /// An upper bound of the distance of the tile's k-th nearest pixel: the k-th least of sixteen minima, each over four
  /// pixels of its own.
  [[nodiscard]] HWY_INLINE float kthOfLanes(const TileDistances& distances) const {
    static_assert(kMaxNeighbours <= static_cast<int>(kGroupBoxes));
    const FloatTag d;
    const IndexTag di;
    alignas(64) BoxLanes least;
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec a = hn::Min(distances.vector(i), distances.vector(i + kGroupBoxes));
      const FloatVec b = hn::Min(distances.vector(i + 2 * kGroupBoxes), distances.vector(i + 3 * kGroupBoxes));
      hn::Store(hn::Min(a, b), d, &least[i]);
    }
    FloatVec kth = hn::Set(d, kInfinity);
    const IndexVec wanted = hn::Set(di, -static_cast<std::int32_t>(k_));
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec candidate = hn::Load(d, &least[i]);
      IndexVec not_farther = hn::Zero(di);  // counted downwards: a mask's lanes are -1
      for (const float other : least) {
        not_farther =
            hn::Add(not_farther, hn::VecFromMask(di, hn::RebindMask(di, hn::Le(hn::Set(d, other), candidate))));
      }
      const auto enough = hn::RebindMask(d, hn::Not(hn::Gt(not_farther, wanted)));
      kth = hn::Min(kth, hn::IfThenElse(enough, candidate, hn::Set(d, kInfinity)));
    }
    return leastLane(kth);
  }

  std::size_t k_;
  std::array<Key, kMaxNeighbours> keys_;  ///< ascending
};

/// Branch and bound from one point: groups, their boxes, the pixels of the tiles.
/// Bounds need no slack for rounding: clamping to a box is exact, and rounded differences, squares and sums grow with
/// what they are made of, so that no pixel computes as nearer than its box.
template <class Nearest>
class Search {
 public:
  Search(const IndexedImage& indexed, const Vec3f& p_C, Nearest& nearest)
      : indexed_(indexed),
        x_(hn::Set(FloatTag(), p_C.x())),
        y_(hn::Set(FloatTag(), p_C.y())),
        z_(hn::Set(FloatTag(), p_C.z())),
        nearest_(nearest) {}

  void run() {
    // As many groups at a time as distances are kept of: all of them, unless the image is very large.
    for (std::size_t first = 0; first < indexed_.boxes.count; first += kSweep) {
      sweep(first, std::min(first + kSweep, indexed_.boxes.count));
    }
  }

 private:
  static constexpr std::size_t kSweep = 2048;

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

  void sweep(std::size_t first, std::size_t end) {
    const FloatTag d;
    alignas(64) std::array<float, kSweep> group_least;
    LeastPlace<kSweep> nearest;
    for (std::size_t group = first; group < end; group += kLanes) {
      const FloatVec distance = leastDistance(indexed_.boxes.bounds[group / kGroupBoxes], group % kGroupBoxes);
      hn::Store(distance, d, &group_least[group - first]);
      nearest.add(distance, group - first);
    }
    if (!(nearest.bound() <= nearest_.reach())) return;

    // The nearest group's two nearest boxes bring the reach down before any other group is opened.
    const auto reach = [this] { return nearest_.reach(); };
    const auto visit = [this](std::uint32_t tile, std::int32_t raw_low, std::int32_t raw_high) {
      this->visit(tile, raw_low, raw_high);
    };
    const auto visit_nearest = [&] {
      candidates_.visitNearest(reach(), visit);
      nearest_.refreshReach();
    };
    expand(first + nearest.place());
    group_least[nearest.place()] = kInfinity;
    for (int i = 0; i < 2; ++i) visit_nearest();

    for (std::size_t group = first; group < end; group += kLanes) {
      const FloatVec distance = hn::Load(d, &group_least[group - first]);
      std::uint32_t near = bitsOf(hn::Le(distance, hn::Set(d, reach())));
      for (; near != 0; near &= near - 1) {
        expand(group + static_cast<std::size_t>(std::countr_zero(near)));
        if (!candidates_.hasRoomForGroup()) candidates_.visitAll(reach, visit);
      }
    }
    constexpr std::size_t kWorthOrdering = 4;
    if (candidates_.size() > kWorthOrdering) visit_nearest();
    candidates_.visitAll(reach, visit);
  }

  /// Adds a group's boxes within reach to the candidates.
  HWY_INLINE void expand(std::size_t group) {
    const FloatTag d;
    const BoxGroup& boxes = indexed_.boxes.groups[group];
    const FloatVec reach = hn::Set(d, nearest_.reach());
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec distance = leastDistance(boxes.bounds, i);
      candidates_.append(boxes, i, distance, hn::Le(distance, reach));
    }
  }

  /// Looks at the tile's pixels with raw depths in `low` .. `high`.
  HWY_INLINE void visit(std::uint32_t tile, std::int32_t low, std::int32_t high) {
    const FloatTag d;
    const IndexTag di;
    const PixelTile& pixels = indexed_.image.tiles()[tile];
    const TangentTile& x = indexed_.rays.x(tile);
    const TangentTile& y = indexed_.rays.y(tile);
    const FloatVec unit = hn::Set(d, indexed_.depth_unit_m);
    const FloatVec p_x = x_;  // copies, which nothing that is stored meanwhile can change
    const FloatVec p_y = y_;
    const FloatVec p_z = z_;
    const std::span<const std::uint16_t> excluded = indexed_.in_range.excluded;
    const IndexVec below = hn::Set(di, low - 1);
    const IndexVec above = hn::Set(di, high + 1);
    nearest_.addTile(tile * static_cast<std::uint32_t>(kTilePixels), [&](std::size_t i) {
      const IndexVec raw = hn::PromoteTo(di, hn::Load(RawTag(), &pixels.raw[i]));
      auto counts = hn::And(hn::Gt(raw, below), hn::Lt(raw, above));
      for (const std::uint16_t value : excluded) counts = hn::AndNot(hn::Eq(raw, hn::Set(di, value)), counts);
      const FloatVec z = hn::Mul(hn::ConvertTo(d, raw), unit);
      const FloatVec dx = hn::Sub(p_x, hn::Mul(hn::Load(d, &x.tangents[i]), z));
      const FloatVec dy = hn::Sub(p_y, hn::Mul(hn::Load(d, &y.tangents[i]), z));
      const FloatVec dz = hn::Sub(p_z, z);
      const FloatVec sq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      return hn::IfThenElse(hn::RebindMask(d, counts), sq, hn::Set(d, kInfinity));
    });
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
