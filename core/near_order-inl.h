// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_NEAR_ORDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_NEAR_ORDER_INL_H_
#undef NANOMAP_CORE_NEAR_ORDER_INL_H_
#else
#define NANOMAP_CORE_NEAR_ORDER_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// Places in the order of a distance each, nearest first, near enough: the low bits of a distance make room for its
/// place, so that one minimum finds both. No two such keys are equal, so that what follows a key is the least one above
/// it, and nothing need be marked as taken: a mark just written is slow to be read back as part of a vector.
template <std::int32_t kPlaces>
class NearOrder {
  static_assert((kPlaces & (kPlaces - 1)) == 0);

 public:
  using Key = std::int32_t;
  static constexpr Key kBeforeAll = -1;
  static constexpr Key kAfterAll = std::numeric_limits<Key>::max();

  /// The keys of `places`. @param distance_sq_m2  zero or more
  [[nodiscard]] static HWY_INLINE IndexVec keysOf(FloatVec distance_sq_m2, IndexVec places) {
    const IndexTag di;
    return hn::OrAnd(places, hn::BitCast(di, distance_sq_m2), hn::Set(di, ~(kPlaces - 1)));
  }

  /// Keys are looked at so many at a time, which is how many there seldom are more of: a branch for each vector of them
  /// would often be foreseen wrongly.
  static constexpr std::size_t kStep = std::min<std::size_t>(32, kPlaces);

  /// The least of `count` keys above `last`; kAfterAll if there is none.
  /// @param keys  aligned, of whole steps, of which what is past `count` is kAfterAll
  [[nodiscard]] static HWY_INLINE Key next(const Key* keys, std::size_t count, Key last) {
    const IndexTag di;
    const IndexVec none = hn::Set(di, kAfterAll);
    const IndexVec taken = hn::Set(di, last);
    IndexVec least = none;
    for (std::size_t step = 0; step < count; step += kStep) {
      for (std::size_t i = step; i < step + kStep; i += kLanes) {
        const IndexVec key = hn::Load(di, keys + i);
        least = hn::Min(least, hn::IfThenElse(hn::Gt(key, taken), key, none));
      }
    }
    return leastLane(least);
  }

  /// No key whose bound is within reach is greater, and no other is less.
  [[nodiscard]] static Key lastWithin(float reach_sq_m2) { return std::bit_cast<Key>(reach_sq_m2) | (kPlaces - 1); }

  /// At most the key's distance, and less by a few bits; not a number for kAfterAll.
  [[nodiscard]] static float bound(Key key) { return std::bit_cast<float>(key & ~(kPlaces - 1)); }
  [[nodiscard]] static std::size_t place(Key key) { return static_cast<std::size_t>(key & (kPlaces - 1)); }
};

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
