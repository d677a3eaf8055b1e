// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_NEAREST_ONE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_NEAREST_ONE_INL_H_
#undef NANOMAP_CORE_NEAREST_ONE_INL_H_
#else
#define NANOMAP_CORE_NEAREST_ONE_INL_H_
#endif

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
      : distance_sq_m2_(hn::Set(FloatTag(), limit_sq_m2)), pixel_(hn::Set(IndexTag(), kNoPixel)) {}

  /// Nothing farther can be the nearest; at this distance a pixel with a lower number can.
  [[nodiscard]] HWY_INLINE float reach() const { return leastLane(distance_sq_m2_); }

  /// @param distanceAt  squared distances of the tile's pixels from a place on
  template <class DistanceAt>
  HWY_INLINE void addTile(std::uint32_t first_pixel, DistanceAt distanceAt) {
    const FloatTag d;
    const IndexTag di;
    FloatVec nearest = distanceAt(std::size_t{0});
    IndexVec place = hn::Zero(di);
    for (std::size_t i = kLanes; i < TileGrid::kTilePixels; i += kLanes) {
      const FloatVec distance = distanceAt(i);
      const auto nearer = hn::RebindMask(di, hn::Lt(distance, nearest));
      place = hn::IfThenElse(nearer, hn::Set(di, static_cast<std::int32_t>(i)), place);
      nearest = hn::Min(distance, nearest);
    }
    const IndexVec pixel = hn::Add(place, countingFrom(first_pixel));
    const auto equal_and_before = hn::And(hn::Eq(nearest, distance_sq_m2_), hn::RebindMask(d, hn::Lt(pixel, pixel_)));
    const auto better = hn::Or(hn::Lt(nearest, distance_sq_m2_), equal_and_before);
    distance_sq_m2_ = hn::Min(nearest, distance_sq_m2_);
    pixel_ = hn::IfThenElse(hn::RebindMask(di, better), pixel, pixel_);
  }

  std::size_t copyTo(std::span<FoundPixel> out) const {
    const float least = reach();
    const auto at_least = hn::RebindMask(IndexTag(), hn::Eq(distance_sq_m2_, hn::Set(FloatTag(), least)));
    const std::int32_t pixel = leastLane(hn::IfThenElse(at_least, pixel_, hn::Set(IndexTag(), kNoPixel)));
    if (pixel == kNoPixel) return 0;
    out[0] = {least, static_cast<std::uint32_t>(pixel)};
    return 1;
  }

 private:
  static constexpr std::int32_t kNoPixel = std::numeric_limits<std::int32_t>::max();

  FloatVec distance_sq_m2_;
  IndexVec pixel_;
};

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
