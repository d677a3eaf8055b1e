// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_NEAREST_MANY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_NEAREST_MANY_INL_H_
#undef NANOMAP_CORE_NEAREST_MANY_INL_H_
#else
#define NANOMAP_CORE_NEAREST_MANY_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/box_groups_search.h"
#include "core/lanes-inl.h"
#include "core/nearest_point_index.h"
#include "core/tile_grid.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// Of sixteen sets of pixels that have none in common, the least squared distance of each.
class SetMinima {
 public:
  HWY_INLINE explicit SetMinima(float at_most_sq_m2) {
    for (FloatVec& v : sq_m2_) v = hn::Set(FloatTag(), at_most_sq_m2);
  }

  /// @param set  the first of as many sets as a vector has lanes; a multiple of these
  HWY_INLINE void add(std::size_t set, FloatVec sq_m2) { sq_m2_[set / kLanes] = hn::Min(sq_m2_[set / kLanes], sq_m2); }

  /// The k-th least of them: the k-th nearest pixel is no farther. @param k  1 .. 16
  [[nodiscard]] HWY_INLINE float kth(std::size_t k) const {
    const FloatTag d;
    const IndexTag di;
    alignas(64) BoxLanes all;
    for (std::size_t i = 0; i < kVectors; ++i) hn::Store(sq_m2_[i], d, &all[i * kLanes]);
    FloatVec kth = hn::Set(d, std::numeric_limits<float>::infinity());
    const IndexVec wanted = hn::Set(di, -static_cast<std::int32_t>(k));
    for (const FloatVec candidate : sq_m2_) {
      IndexVec not_farther = hn::Zero(di);  // counted downwards: a mask's lanes are -1
      for (const float other : all) {
        not_farther =
            hn::Add(not_farther, hn::VecFromMask(di, hn::RebindMask(di, hn::Le(hn::Set(d, other), candidate))));
      }
      const auto enough = hn::RebindMask(d, hn::Not(hn::Gt(not_farther, wanted)));
      kth = hn::Min(kth, hn::IfThenElse(enough, candidate, kth));
    }
    return leastOfPositive(kth);
  }

 private:
  static constexpr std::size_t kVectors = kGroupBoxes / kLanes;

  FloatVec sq_m2_[kVectors];
};

/// Squared distances of a tile's pixels, infinite where a pixel does not count.
struct alignas(64) TileDistances {
  std::array<float, TileGrid::kTilePixels> sq_m2;
  std::uint32_t first_pixel;

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void assign(std::uint32_t first, DistanceAt distanceAt) {
    for (std::size_t i = 0; i < sq_m2.size(); i += kLanes) hn::Store(distanceAt(i), FloatTag(), &sq_m2[i]);
    first_pixel = first;
  }

  /// The pixels within `limit`, one bit each.
  [[nodiscard]] HWY_INLINE std::uint64_t within(float limit_sq_m2) const {
    const FloatVec limit = hn::Set(FloatTag(), limit_sq_m2);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sq_m2.size(); i += kLanes) {
      bits |= static_cast<std::uint64_t>(bitsOf(hn::Le(vector(i), limit))) << i;
    }
    return bits;
  }

  /// Every second pair of lines with its halves swapped: so any four by four pixels are of sixteen sets, as those are
  /// that lie nearest together, and the k-th minimum is close to the k-th distance.
  HWY_INLINE void addTo(SetMinima& minima) const {
    constexpr auto kPair = static_cast<std::size_t>(2 * TileGrid::kTileEdge_px);
    static_assert(kPair == kGroupBoxes && 4 * kPair == TileGrid::kTilePixels);
    for (std::size_t set = 0; set < kPair; set += kLanes) {
      const FloatVec upper = hn::Min(vector(set), withHalvesSwapped(set + kPair));
      const FloatVec lower = hn::Min(vector(set + 2 * kPair), withHalvesSwapped(set + 3 * kPair));
      minima.add(set, hn::Min(upper, lower));
    }
  }

 private:
  [[nodiscard]] HWY_INLINE FloatVec vector(std::size_t first) const { return hn::Load(FloatTag(), &sq_m2[first]); }

  [[nodiscard]] HWY_INLINE FloatVec withHalvesSwapped(std::size_t first) const {
    constexpr std::size_t kHalfLine = TileGrid::kTileEdge_px / 2;
    if constexpr (kLanes <= kHalfLine) {
      return vector(first ^ kHalfLine);
    } else {
      const auto from = hn::Xor(countingFrom(0), hn::Set(IndexTag(), static_cast<std::int32_t>(kHalfLine)));
      return hn::TableLookupLanes(vector(first), hn::IndicesFromVec(FloatTag(), from));
    }
  }
};

/// The k nearest pixels for any k up to kMaxNeighbours. Pixels are inserted into all places at once, without a branch.
class NearestMany {
 public:
  NearestMany(float limit_sq_m2, std::size_t k) : k_(k), reach_sq_m2_(limit_sq_m2) {
    keys_.fill(keyOf(limit_sq_m2, kNoPixel));
  }

  /// Nothing farther can be among the nearest; at this distance a pixel with a lower number can.
  [[nodiscard]] float reach() const { return reach_sq_m2_; }

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void addTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    TileDistances& distances = collected_[0];
    distances.assign(first_pixel, distanceAt);
    std::uint64_t places = distances.within(reach_sq_m2_);
    if (static_cast<std::size_t>(std::popcount(places)) > k_) {
      SetMinima minima(reach_sq_m2_);
      distances.addTo(minima);
      places &= distances.within(minima.kth(k_));
    }
    if (places != 0) insert(distances, places);
  }

  /// Tiles before a reach is known, of which all but a few pixels would be inserted in vain: they wait for
  /// addCollected(), which comes before any addTile(). @pre fewer than kCollected are waiting
  template <class DistanceAt>
  HWY_INLINE void collectTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    collected_[collected_count_++].assign(first_pixel, distanceAt);
  }

  static constexpr std::size_t kCollected = 2;

  HWY_INLINE void addCollected() {
    SetMinima minima(reach_sq_m2_);
    for (std::size_t i = 0; i < collected_count_; ++i) collected_[i].addTo(minima);
    reach_sq_m2_ = minima.kth(k_);
    for (std::size_t i = 0; i < collected_count_; ++i) {
      const std::uint64_t places = collected_[i].within(reach_sq_m2_);
      if (places != 0) insert(collected_[i], places);
    }
    collected_count_ = 0;
  }

  std::size_t copyTo(std::span<FoundPixel> out) const {
    std::size_t count = 0;
    for (; count < k_ && pixelOf(keys_[count]) != kNoPixel; ++count) {
      out[count] = {distanceOf(keys_[count]), pixelOf(keys_[count])};
    }
    return count;
  }

 private:
  /// A distance's bits above the pixel's: orders as distance, then pixel, since the bits of floats that are not
  /// negative order as the floats do. The same holds for doubles, which every instruction set has a minimum of; one in
  /// the exponent keeps them from being denormal, and infinity's stays below the greatest exponent.
  using Key = double;
  using KeyTag = hn::CappedTag<Key, kMaxNeighbours>;
  using KeyVec = hn::Vec<KeyTag>;
  static constexpr std::size_t kKeyLanes = hn::MaxLanes(KeyTag());
  static constexpr std::size_t kKeyVectors = kMaxNeighbours / kKeyLanes;
  static constexpr std::uint64_t kNormal = std::uint64_t{1} << 52;
  static constexpr std::uint32_t kNoPixel = std::numeric_limits<std::uint32_t>::max();

  static Key keyOf(float distance_sq_m2, std::uint32_t pixel) {
    return std::bit_cast<Key>((std::uint64_t{std::bit_cast<std::uint32_t>(distance_sq_m2)} << 32 | pixel) + kNormal);
  }
  static float distanceOf(Key key) {
    return std::bit_cast<float>(static_cast<std::uint32_t>((std::bit_cast<std::uint64_t>(key) - kNormal) >> 32));
  }
  static std::uint32_t pixelOf(Key key) { return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(key)); }

  /// To move lanes on, the last ones to the front.
  static HWY_INLINE auto rotationBy(std::size_t lanes) {
    alignas(64) std::array<std::int64_t, kKeyLanes> from;
    for (std::size_t i = 0; i < kKeyLanes; ++i)
      from[i] = static_cast<std::int64_t>((i + kKeyLanes - lanes) % kKeyLanes);
    return hn::SetTableIndices(KeyTag(), from.data());
  }

  /// Two at a time: a key is the least of what was in its place, of what was one place before or the lesser of the two,
  /// whichever is greater, and of what was two places before or the greater of the two.
  HWY_INLINE void insert(const TileDistances& distances, std::uint64_t places) {
    const KeyTag d;
    const auto by_one = rotationBy(1);
    const auto by_two = rotationBy(2);
    const auto first_lane = hn::FirstN(d, 1);
    const auto first_two_lanes = hn::FirstN(d, 2);
    const auto takeKey = [&] {
      if (places == 0) return keyOf(std::numeric_limits<float>::infinity(), kNoPixel);
      const auto place = static_cast<std::size_t>(std::countr_zero(places));
      places &= places - 1;
      return keyOf(distances.sq_m2[place], distances.first_pixel + static_cast<std::uint32_t>(place));
    };

    KeyVec keys[kKeyVectors];
    for (std::size_t i = 0; i < kKeyVectors; ++i) keys[i] = hn::Load(d, &keys_[i * kKeyLanes]);
    while (places != 0) {
      const KeyVec a = hn::Set(d, takeKey());
      const KeyVec b = hn::Set(d, takeKey());
      const KeyVec lesser = hn::Min(a, b);
      const KeyVec greater = hn::Max(a, b);
      KeyVec carry_one = hn::Zero(d);
      KeyVec carry_two = hn::Zero(d);
      for (KeyVec& of : keys) {
        const KeyVec one_on = hn::TableLookupLanes(of, by_one);
        const KeyVec two_on = hn::TableLookupLanes(of, by_two);
        const KeyVec one_before = hn::IfThenElse(first_lane, carry_one, one_on);
        const KeyVec two_before = hn::IfThenElse(first_two_lanes, carry_two, two_on);
        of = hn::Min(of, hn::Min(hn::Max(lesser, one_before), hn::Max(greater, two_before)));
        carry_one = one_on;
        carry_two = two_on;
      }
    }
    for (std::size_t i = 0; i < kKeyVectors; ++i) hn::Store(keys[i], d, &keys_[i * kKeyLanes]);
    reach_sq_m2_ = std::min(reach_sq_m2_, distanceOf(keys_[k_ - 1]));
  }

  std::size_t k_;
  float reach_sq_m2_;
  alignas(64) std::array<Key, kMaxNeighbours> keys_;  ///< ascending
  std::array<TileDistances, kCollected> collected_;
  std::size_t collected_count_ = 0;
};

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
