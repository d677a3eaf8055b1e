#include "core/depth_tiles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth_tiles.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

#ifndef NANOMAP_CORE_DEPTH_TILES_CC_ONCE
#define NANOMAP_CORE_DEPTH_TILES_CC_ONCE
namespace nanomap {
namespace {

/// Rows of tiles of an image, and where what is found of one row of them goes.
struct TileRow {
  std::span<const std::uint16_t> pixels;  ///< of the image
  std::size_t width_px;
  std::size_t top;
  std::size_t bottom;                        ///< past the last row, at most a tile's edge below the top
  std::span<const std::uint16_t> no_return;  ///< values
  std::uint16_t* least;                      ///< one a tile, as the others
  DepthTiles::Cover* cover;
  DepthTiles::Gaps* gaps;
};

}  // namespace
}  // namespace nanomap
#endif

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr auto kEdge = static_cast<std::size_t>(DepthTiles::kEdge_px);

// Each 128-bit part of a vector holds eight pixels of one tile.
using RawTag = hn::CappedTag<std::uint16_t, 4 * kEdge>;
using RawVec = hn::Vec<RawTag>;
constexpr std::size_t kColumns = hn::MaxLanes(RawTag());
constexpr std::size_t kTiles = kColumns / kEdge;

/// In every lane what `pick` leaves of its part.
template <class Pick>
HWY_INLINE RawVec overParts(RawVec v, Pick pick) {
  const RawTag d;
  const hn::Repartition<std::uint32_t, RawTag> d32;
  v = pick(v, hn::BitCast(d, hn::Shuffle1032(hn::BitCast(d32, v))));
  v = pick(v, hn::BitCast(d, hn::Shuffle2301(hn::BitCast(d32, v))));
  return pick(v, hn::BitCast(d, hn::RotateRight<16>(hn::BitCast(d32, v))));
}

/// Calls `set(tile, first lane of its part)`.
template <class Set>
HWY_INLINE void eachPart(RawVec v, std::size_t tiles, Set set) {
  alignas(64) std::array<std::uint16_t, kColumns> lanes;
  hn::Store(v, RawTag(), lanes.data());
  for (std::size_t tile = 0; tile < tiles; ++tile) set(tile, lanes[tile * kEdge]);
}

alignas(64) constexpr auto kColumnBits = [] {
  std::array<std::uint16_t, kColumns> bits{};
  for (std::size_t i = 0; i < kColumns; ++i) bits[i] = static_cast<std::uint16_t>(1U << i % kEdge);
  return bits;
}();

/// Covers of `tiles` tiles. @param greatest  of each column, 0 without any
HWY_INLINE void coverTiles(RawVec greatest, RawVec gap_lines, std::size_t tiles, DepthTiles::Cover* out) {
  using Cover = DepthTiles::Cover;
  const RawTag d;
  const hn::Repartition<std::int32_t, RawTag> dw;  // of which a part holds half a line
  using WideVec = hn::Vec<decltype(dw)>;
  const RawVec zero = hn::Zero(d);
  const auto widened = [&](RawVec v) { return hn::BitCast(dw, hn::InterleaveLower(d, v, zero)); };
  const auto widenedRightHalf = [&](RawVec v) { return hn::BitCast(dw, hn::InterleaveUpper(d, v, zero)); };
  const auto higher = [](RawVec a, RawVec b) { return hn::Max(a, b); };

  constexpr auto kRoundedUp = static_cast<std::uint16_t>((1 << Cover::kBitsRounded) - 1);
  const RawVec top = hn::Or(overParts(greatest, higher), hn::Set(d, kRoundedUp));
  const RawVec down = hn::IfThenZeroElse(hn::Eq(greatest, zero), hn::Sub(top, greatest));
  // The exponent of a float tells which bit is the first.
  constexpr int kMantissaBits = 23;
  constexpr int kExponentBias = 127;
  const auto farthest_down = hn::ConvertTo(hn::RebindToFloat<decltype(dw)>(), widened(overParts(down, higher)));
  const WideVec exponent = hn::ShiftRight<kMantissaBits>(hn::BitCast(dw, farthest_down));
  constexpr int kExponentOfMostSteps = kExponentBias + Cover::kBitsOfColumn - 1;
  const WideVec shift = hn::Max(hn::Sub(exponent, hn::Set(dw, kExponentOfMostSteps)), hn::Zero(dw));
  const WideVec bits = hn::Or(hn::ShiftLeft<Cover::kStepBits>(widened(gap_lines)), shift);
  const WideVec depth = hn::ShiftRight<Cover::kBitsRounded>(widened(top));

  alignas(16) constexpr std::array<std::int32_t, kEdge> kPlaces = {0, 4, 8, 12, 16, 20, 24, 28};
  static_assert(kPlaces.back() == (kEdge - 1) * Cover::kBitsOfColumn);
  const WideVec left = hn::Shl(hn::Shr(widened(down), shift), hn::LoadDup128(dw, kPlaces.data()));
  const WideVec right = hn::Shl(hn::Shr(widenedRightHalf(down), shift), hn::LoadDup128(dw, &kPlaces[kEdge / 2]));
  WideVec steps = hn::Or(left, right);
  steps = hn::Or(steps, hn::Shuffle1032(steps));
  steps = hn::Or(steps, hn::Shuffle2301(steps));

  alignas(64) std::array<std::int32_t, kColumns / 2> bits_of_part;
  alignas(64) std::array<std::int32_t, kColumns / 2> steps_of_part;
  hn::Store(hn::Or(hn::ShiftLeft<Cover::kDepthBits>(bits), depth), dw, bits_of_part.data());
  hn::Store(steps, dw, steps_of_part.data());
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const std::size_t part = tile * kEdge / 2;
    out[tile] = {static_cast<std::uint32_t>(bits_of_part[part]), static_cast<std::uint32_t>(steps_of_part[part])};
  }
}

/// Bounds `tiles` tiles, of which eight rows start at `pixels`, `stride` apart; those from `first_tile` on.
HWY_INLINE void boundTiles(const TileRow& row, const std::uint16_t* pixels, std::size_t stride, std::size_t first_tile,
                           std::size_t tiles) {
  const RawTag d;
  RawVec least = hn::Set(d, DepthTiles::kNoDepth);
  RawVec greatest = hn::Zero(d);
  RawVec gaps = hn::Zero(d);
  for (std::size_t v = 0; v < kEdge; ++v) {
    const RawVec raw = hn::LoadU(d, pixels + v * stride);
    RawVec gap = hn::Zero(d);
    for (const std::uint16_t value : row.no_return) {
      gap = hn::Or(gap, hn::VecFromMask(d, hn::Eq(raw, hn::Set(d, value))));
    }
    least = hn::Min(least, hn::Or(raw, gap));
    greatest = hn::Max(greatest, hn::AndNot(gap, raw));
    gaps = hn::Or(gaps, hn::And(gap, hn::Set(d, static_cast<std::uint16_t>(1U << v))));
  }
  const auto lower = [](RawVec a, RawVec b) { return hn::Min(a, b); };
  const auto either = [](RawVec a, RawVec b) { return hn::Or(a, b); };
  const RawVec gap_columns = hn::IfThenZeroElse(hn::Eq(gaps, hn::Zero(d)), hn::Load(d, kColumnBits.data()));
  const RawVec gap_lines = hn::Or(gap_columns, hn::ShiftLeft<DepthTiles::kEdge_px>(gaps));
  coverTiles(greatest, overParts(gap_lines, either), tiles, row.cover + first_tile);
  eachPart(overParts(least, lower), tiles, [&](std::size_t i, std::uint16_t v) { row.least[first_tile + i] = v; });

  const hn::Rebind<std::uint8_t, RawTag> d8;
  alignas(64) std::array<DepthTiles::Gaps, kTiles> columns;
  hn::Store(hn::DemoteTo(d8, hn::BitCast(hn::RebindToSigned<RawTag>(), gaps)), d8, columns.front().data());
  std::copy_n(columns.begin(), tiles, row.gaps + first_tile);
}

void boundRow(const TileRow& row) {
  const std::size_t width = row.width_px;
  for (std::size_t left = 0; left < width; left += kColumns) {
    const std::size_t columns = std::min(kColumns, width - left);
    const std::size_t tiles = (columns + kEdge - 1) / kEdge;
    if (columns == kColumns && row.bottom - row.top == kEdge) {
      boundTiles(row, &row.pixels[row.top * width + left], width, left / kEdge, tiles);
      continue;
    }
    // Beyond the border the nearest pixel inside, which moves no bound.
    std::array<std::uint16_t, kEdge * kColumns> bordered;
    for (std::size_t v = 0; v < kEdge; ++v) {
      const std::uint16_t* from = &row.pixels[std::min(row.top + v, row.bottom - 1) * width + left];
      for (std::size_t u = 0; u < kColumns; ++u) bordered[v * kColumns + u] = from[std::min(u, columns - 1)];
    }
    boundTiles(row, bordered.data(), kColumns, left / kEdge, tiles);
  }
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(boundRow);

namespace {

int tilesAlong(int pixels) { return (pixels + DepthTiles::kEdge_px - 1) / DepthTiles::kEdge_px; }

}  // namespace

DepthTiles::DepthTiles(const CameraModel& camera)
    : columns_(tilesAlong(camera.width())),
      rows_(tilesAlong(camera.height())),
      least_(tileAt(0, rows_), kNoDepth),
      cover_(tileAt(0, rows_)),
      gaps_(tileAt(0, rows_)) {
  Gaps everywhere;
  everywhere.fill(0xFF);
  std::fill(gaps_.begin(), gaps_.end(), everywhere);
}

void DepthTiles::assign(const DepthImage& image, const CameraModel& camera) {
  for (int row = 0; row < rows_; ++row) {
    const std::size_t first = tileAt(0, row);
    const int top = row * kEdge_px;
    HWY_DYNAMIC_DISPATCH(boundRow)
    ({.pixels = image.pixels,
      .width_px = static_cast<std::size_t>(image.width_px),
      .top = static_cast<std::size_t>(top),
      .bottom = static_cast<std::size_t>(std::min(top + kEdge_px, image.height_px)),
      .no_return = camera.parameters().no_return_values,
      .least = &least_[first],
      .cover = &cover_[first],
      .gaps = &gaps_[first]});
  }
}

}  // namespace nanomap
#endif
