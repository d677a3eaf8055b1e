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

/// The first lane of `v` that equals `value`. @pre there is one
HWY_INLINE std::size_t laneOf(FloatVec v, float value) {
  const FloatTag d;
  return static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Eq(v, hn::Set(d, value))));
}

/// Boxes, or groups, that may hold something near enough, with how near that can be at best.
class Candidates {
 public:
  static constexpr std::size_t kCapacity = 256;

  /// Those of the vector's lanes in `chosen`; lane i is called `first + i`. @pre there is room for a vector
  HWY_INLINE void append(FloatVec least_sq_m2, hn::Mask<FloatTag> chosen, std::uint32_t first) {
    const FloatTag d;
    const IndexTag di;
    const auto names = hn::BitCast(d, hn::Iota(di, static_cast<std::int32_t>(first)));
    hn::CompressStore(names, chosen, d, names_.data() + size_);
    size_ += hn::CompressStore(least_sq_m2, chosen, d, least_sq_m2_.data() + size_);
  }

  [[nodiscard]] bool hasRoomForGroup() const { return size_ + kGroupBoxes <= kCapacity; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] float least(std::size_t i) const { return least_sq_m2_[i]; }
  [[nodiscard]] std::uint32_t name(std::size_t i) const { return std::bit_cast<std::uint32_t>(names_[i]); }
  void clear() { size_ = 0; }

  /// Where the nearest stands. @pre not empty
  [[nodiscard]] std::size_t nearest() {
    const FloatTag d;
    hn::StoreU(hn::Set(d, kInfinity), d, &least_sq_m2_[size_]);
    FloatVec least = hn::Load(d, least_sq_m2_.data());
    for (std::size_t i = kLanes; i < size_; i += kLanes) least = hn::Min(least, hn::Load(d, &least_sq_m2_[i]));
    const float value = leastLane(least);
    std::size_t i = 0;
    while (hn::AllFalse(d, hn::Eq(hn::Load(d, &least_sq_m2_[i]), hn::Set(d, value)))) i += kLanes;
    return i + laneOf(hn::Load(d, &least_sq_m2_[i]), value);
  }

  /// Takes it out of consideration.
  void strike(std::size_t i) { least_sq_m2_[i] = kInfinity; }

 private:
  // CompressStore may write a vector past the last.
  alignas(64) std::array<float, kCapacity + kGroupBoxes> least_sq_m2_;
  alignas(64) std::array<float, kCapacity + kGroupBoxes> names_;
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

/// The k nearest pixels of a single k: one.
class NearestOne {
 public:
  explicit NearestOne(float limit_sq_m2) : found_{limit_sq_m2, std::numeric_limits<std::uint32_t>::max()} {}

  /// Nothing farther can be among the nearest; at this distance a pixel with a lower number can.
  [[nodiscard]] float reach() const { return found_.distance_sq_m2; }

  /// @param least  the least distances in the tile, by lanes. @pre one of them is within reach
  HWY_INLINE void add(std::uint32_t first_pixel, const TileDistances& distances, FloatVec least) {
    const float value = leastLane(least);
    std::uint32_t place = 0;
    const FloatVec sought = hn::Set(FloatTag(), value);
    std::uint32_t lanes = 0;
    while ((lanes = bitsOf(hn::Eq(distances.vector(place), sought))) == 0) place += static_cast<std::uint32_t>(kLanes);
    const std::uint32_t pixel = first_pixel + place + static_cast<std::uint32_t>(std::countr_zero(lanes));
    if (value < found_.distance_sq_m2 || pixel < found_.pixel) found_ = {value, pixel};
  }

  std::size_t copyTo(std::span<FoundPixel> out) const {
    if (found_.pixel == std::numeric_limits<std::uint32_t>::max()) return 0;
    out[0] = found_;
    return 1;
  }

 private:
  FoundPixel found_;
};

/// The k nearest pixels for any k up to kMaxNeighbours.
class NearestMany {
 public:
  NearestMany(float limit_sq_m2, std::size_t k) : k_(k) { keys_.fill(keyOf(limit_sq_m2, kNoPixel)); }

  [[nodiscard]] float reach() const { return distanceOf(keys_[k_ - 1]); }

  HWY_INLINE void add(std::uint32_t first_pixel, const TileDistances& distances, FloatVec /*least*/) {
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
    const IndexTag di;
    alignas(64) std::array<float, kSweep> group_least;
    FloatVec least = hn::Set(d, kInfinity);
    IndexVec at = hn::Zero(di);
    for (std::size_t group = first; group < end; group += kLanes) {
      const FloatVec distance = leastDistance(indexed_.boxes.bounds[group / kGroupBoxes], group % kGroupBoxes);
      hn::Store(distance, d, &group_least[group - first]);
      const auto nearer = hn::Lt(distance, least);
      least = hn::Min(least, distance);
      at = hn::IfThenElse(hn::RebindMask(di, nearer), hn::Set(di, static_cast<std::int32_t>(group)), at);
    }
    const float nearest_group_sq_m2 = leastLane(least);
    if (!(nearest_group_sq_m2 <= nearest_.reach()) || nearest_group_sq_m2 == kInfinity) return;

    // The nearest box of the nearest group first: it sets the reach.
    const std::size_t lane = laneOf(least, nearest_group_sq_m2);
    alignas(64) std::array<std::int32_t, kLanes> lanes_at;
    hn::Store(at, di, lanes_at.data());
    const std::uint32_t seed = nearestBoxOf(static_cast<std::size_t>(lanes_at[lane]) + lane);
    visit(seed);

    for (std::size_t group = first; group < end; group += kLanes) {
      const FloatVec distance = hn::Load(d, &group_least[group - first]);
      std::uint32_t near = bitsOf(hn::Le(distance, hn::Set(d, nearest_.reach())));
      for (; near != 0; near &= near - 1) {
        expand(group + static_cast<std::size_t>(std::countr_zero(near)));
        if (!candidates_.hasRoomForGroup()) visitCandidates(seed);
      }
    }
    visitCandidates(seed);
  }

  [[nodiscard]] std::uint32_t nearestBoxOf(std::size_t group) const {
    const FloatTag d;
    const BoxBounds& boxes = indexed_.boxes.groups[group].bounds;
    alignas(64) BoxLanes distances;
    FloatVec least = hn::Set(d, kInfinity);
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec distance = leastDistance(boxes, i);
      hn::Store(distance, d, &distances[i]);
      least = hn::Min(least, distance);
    }
    const float value = leastLane(least);
    std::size_t i = 0;
    while (hn::AllFalse(d, hn::Eq(hn::Load(d, &distances[i]), hn::Set(d, value)))) i += kLanes;
    return static_cast<std::uint32_t>(group * kGroupBoxes + i + laneOf(hn::Load(d, &distances[i]), value));
  }

  /// Adds a group's boxes within reach to the candidates.
  HWY_INLINE void expand(std::size_t group) {
    const FloatTag d;
    const BoxBounds& boxes = indexed_.boxes.groups[group].bounds;
    const FloatVec reach = hn::Set(d, nearest_.reach());
    for (std::size_t i = 0; i < kGroupBoxes; i += kLanes) {
      const FloatVec distance = leastDistance(boxes, i);
      candidates_.append(distance, hn::Le(distance, reach), static_cast<std::uint32_t>(group * kGroupBoxes + i));
    }
  }

  /// Visits the candidates, the nearest one first, but not the box `seed`, which has been.
  void visitCandidates(std::uint32_t seed) {
    constexpr std::size_t kWorthOrdering = 4;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_.name(i) == seed) candidates_.strike(i);
    }
    if (candidates_.size() > kWorthOrdering) {
      const std::size_t i = candidates_.nearest();
      if (candidates_.least(i) <= nearest_.reach()) visit(candidates_.name(i));
      candidates_.strike(i);
    }
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_.least(i) <= nearest_.reach()) visit(candidates_.name(i));
    }
    candidates_.clear();
  }

  /// Looks at all pixels of a box: group * kGroupBoxes + lane.
  HWY_INLINE void visit(std::uint32_t box) {
    const BoxGroup& group = indexed_.boxes.groups[box / kGroupBoxes];
    const std::size_t lane = box % kGroupBoxes;
    const std::uint32_t tile = group.tile[lane];
    const FloatTag d;
    const FloatVec least = measure(tile, group.raw_low[lane], group.raw_high[lane]);
    if (hn::AllFalse(d, hn::Le(least, hn::Set(d, nearest_.reach())))) return;
    nearest_.add(tile * static_cast<std::uint32_t>(kTilePixels), distances_, least);
  }

  /// Fills distances_ for the tile's pixels with raw depths in `low` .. `high`. @return their least, by lanes
  HWY_INLINE FloatVec measure(std::uint32_t tile, std::uint16_t low, std::uint16_t high) {
    const FloatTag d;
    const IndexTag di;
    const PixelTile& pixels = indexed_.image.tiles()[tile];
    const TangentTile& x = indexed_.rays.x(tile);
    const TangentTile& y = indexed_.rays.y(tile);
    const FloatVec unit = hn::Set(d, indexed_.depth_unit_m);
    const IndexVec below = hn::Set(di, low - 1);
    const IndexVec above = hn::Set(di, high + 1);
    FloatVec least = hn::Set(d, kInfinity);
    for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
      const IndexVec raw = hn::PromoteTo(di, hn::Load(RawTag(), &pixels.raw[i]));
      auto counts = hn::And(hn::Gt(raw, below), hn::Lt(raw, above));
      for (const std::uint16_t value : indexed_.in_range.excluded) {
        counts = hn::AndNot(hn::Eq(raw, hn::Set(di, value)), counts);
      }
      const FloatVec z = hn::Mul(hn::ConvertTo(d, raw), unit);
      const FloatVec dx = hn::Sub(x_, hn::Mul(hn::Load(d, &x.tangents[i]), z));
      const FloatVec dy = hn::Sub(y_, hn::Mul(hn::Load(d, &y.tangents[i]), z));
      const FloatVec dz = hn::Sub(z_, z);
      const FloatVec sq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      const FloatVec distance = hn::IfThenElse(hn::RebindMask(d, counts), sq, hn::Set(d, kInfinity));
      hn::Store(distance, d, &distances_.sq_m2[i]);
      least = hn::Min(least, distance);
    }
    return least;
  }

  const IndexedImage& indexed_;
  FloatVec x_;
  FloatVec y_;
  FloatVec z_;
  Nearest& nearest_;
  Candidates candidates_;
  TileDistances distances_;
};

std::size_t find(const IndexedImage& indexed, const Vec3f& p_C, float limit_sq_m2, std::span<FoundPixel> out) {
  const auto run = [&](auto nearest) {
    Search search(indexed, p_C, nearest);
    search.run();
    return nearest.copyTo(out);
  };
  return out.size() == 1 ? run(NearestOne(limit_sq_m2)) : run(NearestMany(limit_sq_m2, out.size()));
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
