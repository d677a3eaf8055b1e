// Vectors as the nearest-point index uses them, for each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_LANES_INL_H_
#undef NANOMAP_CORE_LANES_INL_H_
#else
#define NANOMAP_CORE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/box_groups.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// As many floats as a vector holds, sixteen at most: a group's boxes are a whole number of vectors.
using FloatTag = hn::CappedTag<float, kGroupBoxes>;
using IndexTag = hn::RebindToSigned<FloatTag>;
using FloatVec = hn::Vec<FloatTag>;
using IndexVec = hn::Vec<IndexTag>;

constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());

/// The lanes of a mask, one bit each.
template <class Mask>
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};  // what StoreMaskBits may write
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
}

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
/// For every set of lanes, its members in front.
alignas(64) constexpr auto kChosenInFront = [] {
  std::array<std::array<std::int32_t, kLanes>, std::size_t{1} << kLanes> lanes{};
  for (std::size_t set = 0; set < lanes.size(); ++set) {
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((set >> lane & 1U) != 0) lanes[set][count++] = static_cast<std::int32_t>(lane);
    }
  }
  return lanes;
}();

/// The chosen lanes in front, in their order; the rest is undefined. As hn::Compress, whose table (Highway 1.0.3, GCC
/// 12) is copied to the stack at every use.
template <class V, class Mask>
HWY_INLINE V chosenInFront(V v, Mask mask) {
  const std::uint32_t set = bitsOf(hn::RebindMask(FloatTag(), mask));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(hn::DFromV<V>(), hn::Load(IndexTag(), kChosenInFront[set].data())));
}
#else
template <class V, class Mask>
HWY_INLINE V chosenInFront(V v, Mask mask) {
  return hn::Compress(v, mask);
}
#endif

HWY_INLINE float leastLane(FloatVec v) { return hn::GetLane(hn::MinOfLanes(FloatTag(), v)); }
HWY_INLINE float greatestLane(FloatVec v) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), v)); }
HWY_INLINE std::int32_t leastLane(IndexVec v) { return hn::GetLane(hn::MinOfLanes(IndexTag(), v)); }

/// The same for lanes that are zero or more: their bits order as they do, and integers compare sooner.
HWY_INLINE float leastOfPositive(FloatVec v) { return std::bit_cast<float>(leastLane(hn::BitCast(IndexTag(), v))); }

alignas(64) constexpr std::array<std::int32_t, kGroupBoxes> kCounting = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                         8, 9, 10, 11, 12, 13, 14, 15};

/// first, first + 1, ...
HWY_INLINE IndexVec countingFrom(std::size_t first) {
  const IndexTag d;
  return hn::Add(hn::Load(d, kCounting.data()), hn::Set(d, static_cast<std::int32_t>(first)));
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
