// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_NEAREST_ONE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_NEAREST_ONE_INL_H_
#undef NANOMAP_CORE_NEAREST_ONE_INL_H_
#else
#define NANOMAP_CORE_NEAREST_ONE_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/box_groups_search.h"
#include "core/lanes-inl.h"
#include "core/tile_grid.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// The nearest pixel. Lanes keep a nearest one each.
class NearestOne {
 public:
  HWY_INLINE explicit NearestOne(float limit_sq_m2)
      : bits_(hn::Set(IndexTag(), std::bit_cast<std::int32_t>(limit_sq_m2))), pixel_(hn::Set(IndexTag(), kNoPixel)) {}

  /// Nothing farther can be the nearest; at this distance a pixel with a lower number can.
  [[nodiscard]] HWY_INLINE float reach() const { return std::bit_cast<float>(leastLane(bits_)); }

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void addTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    const IndexTag di;
    const auto bitsAt = [&](std::size_t i) { return hn::BitCast(di, distanceAt(i)); };
    IndexVec nearest = bitsAt(std::size_t{0});
    IndexVec place = hn::Zero(di);
    HWY_UNROLL(4)
    for (std::size_t i = kLanes; i < TileGrid::kTilePixels; i += kLanes) {
      const IndexVec distance = bitsAt(i);
      place = hn::IfThenElse(hn::Lt(distance, nearest), hn::Set(di, static_cast<std::int32_t>(i)), place);
      nearest = hn::Min(distance, nearest);
    }
    const IndexVec pixel = hn::Add(place, countingFrom(first_pixel));
    const auto equal_and_before = hn::And(hn::Eq(nearest, bits_), hn::Lt(pixel, pixel_));
    const auto better = hn::Or(hn::Lt(nearest, bits_), equal_and_before);
    bits_ = hn::Min(nearest, bits_);
    pixel_ = hn::IfThenElse(better, pixel, pixel_);
  }

  static constexpr std::size_t kCollected = 2;

  /// As addTile(): waiting for others would gain nothing.
  template <class DistanceAt>
  HWY_INLINE void collectTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    addTile(first_pixel, distanceAt);
  }
  HWY_INLINE void addCollected() {}

  std::size_t copyTo(std::span<FoundPixel> out) const {
    const std::int32_t least = leastLane(bits_);
    const auto at_least = hn::Eq(bits_, hn::Set(IndexTag(), least));
    const std::int32_t pixel = leastLane(hn::IfThenElse(at_least, pixel_, hn::Set(IndexTag(), kNoPixel)));
    if (pixel == kNoPixel) return 0;
    out[0] = {std::bit_cast<float>(least), static_cast<std::uint32_t>(pixel)};
    return 1;
  }

 private:
  static constexpr std::int32_t kNoPixel = std::numeric_limits<std::int32_t>::max();

  /// Of the squared distances [m^2], which are not negative: they order as the floats do, and integers compare sooner.
  IndexVec bits_;
  IndexVec pixel_;
};

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
