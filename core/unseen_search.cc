#include "core/unseen_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/gaps_of_tile.h"
#include "core/open_sky.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/unseen_search.cc"
#include "core/simd.h"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on
#include "core/lanes-inl.h"
#include "core/ray_distance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

constexpr int kEdge_px = DepthTiles::kEdge_px;
static_assert(kEdge_px == TileGrid::kTileEdge_px);

/// Branch and bound: tiles by how near a ray of theirs could be unseen, then their rays.
class BallSearch {
 public:
  explicit BallSearch(const UnseenSearch& search)
      : s_(search),
        camera_(search.view.camera()),
        tiles_(search.view.tiles()),
        distance_(search.p_C),
        near_m_(static_cast<float>(camera_.frustum().near_m)),
        slack_m2_(distance_.boundSlack_m2(search.radius_m * search.radius_m)),
        enough_sq_m2_(search.enough_m * search.enough_m),
        least_sq_m2_(search.radius_m * search.radius_m) {}

  NearestUnseen run() {
    if (s_.look_first_C) lookAt(*s_.look_first_C);
    const Span columns = reached(camera_.tileTangents().columns(), s_.p_C.x());
    const Span rows = reached(camera_.tileTangents().rows(), s_.p_C.y());
    for (std::size_t row = rows.first; row < rows.end && !isEnough(); ++row) searchRow(row, columns);
    return {at_C_ ? std::sqrt(least_sq_m2_) : s_.radius_m, at_C_};
  }

 private:
  /// Columns or rows of tiles from `first` on and before `end`.
  struct Span {
    std::size_t first;
    std::size_t end;
  };

  /// A tile's rays and pixels, place by place.
  struct Tile {
    const TangentTile& tan_x;
    const TangentTile& tan_y;
    const PixelTile& pixels;
    PixelRect rect;
    std::uint64_t gaps;  ///< bits of the places without depth
  };

  [[nodiscard]] bool isEnough() const { return least_sq_m2_ <= enough_sq_m2_; }

  void lookAt(const Vec3f& at_C) {
    if (!(at_C.z() > 0.0F)) return;
    const Eigen::Vector2d tangents = (at_C.head<2>() / at_C.z()).cast<double>();
    const auto pixel = camera_.pixelAt(tangents.x(), tangents.y());
    if (pixel) searchTile(pixel->u / kEdge_px, pixel->v / kEdge_px);
  }

  /// Those with rays that may meet the ball. `at_m` is its middle along the axis of the tangents.
  [[nodiscard]] Span reached(const TileTangents::Ranges& ranges, float at_m) const {
    Span span{0, ranges.size()};
    const float z_m = s_.p_C.z();
    const float square_m2 = least_sq_m2_ + slack_m2_;
    const float ahead_m2 = z_m * z_m - square_m2;
    if (!(ahead_m2 > slack_m2_)) return span;  // it reaches around the camera
    // The two tangents from the camera to a circle.
    const float reach_m2 = std::sqrt(square_m2 * (at_m * at_m + ahead_m2)) + slack_m2_;
    const float least = (at_m * z_m - reach_m2) / ahead_m2;
    const float greatest = (at_m * z_m + reach_m2) / ahead_m2;
    while (span.first < span.end && ranges.greatest[span.first] < least) ++span.first;
    while (span.end > span.first && ranges.least[span.end - 1] > greatest) --span.end;
    return span;
  }

  void searchRow(std::size_t row, const Span& columns) {
    const FloatTag d;
    const TileTangents& tangents = camera_.tileTangents();
    const RayDistance::Tangents y{hn::Set(d, tangents.rows().least[row]), hn::Set(d, tangents.rows().greatest[row])};
    const std::size_t first_tile = tiles_.tileAt(0, static_cast<int>(row));
    for (std::size_t first = columns.first; first < columns.end && !isEnough(); first += kLanes) {
      alignas(64) std::array<float, kLanes> begin_m;
      alignas(64) std::array<float, kLanes> x_least;
      alignas(64) std::array<float, kLanes> x_greatest;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const std::size_t column = std::min(first + i, columns.end - 1);
        begin_m[i] = leastBegin_m(first_tile + column);
        x_least[i] = tangents.columns().least[column];
        x_greatest[i] = tangents.columns().greatest[column];
      }
      const RayDistance::Tangents x{hn::Load(d, x_least.data()), hn::Load(d, x_greatest.data())};
      const FloatVec bound = distance_.boundOfBundles_m2(x, y, hn::Load(d, begin_m.data()));
      std::uint32_t near = bitsOf(hn::Lt(bound, hn::Set(d, least_sq_m2_ + slack_m2_)));
      if (columns.end - first < kLanes) near &= (1U << (columns.end - first)) - 1U;
      for (; near != 0 && !isEnough(); near &= near - 1) {
        searchTile(static_cast<int>(first) + std::countr_zero(near), static_cast<int>(row));
      }
    }
  }

  /// No ray of the tile is unseen nearer to the camera.
  [[nodiscard]] float leastBegin_m(std::size_t tile) const {
    const float least_m = camera_.depth(tiles_.least()[tile]);
    return tiles_.hasGap(tile) ? std::min(least_m, near_m_) : least_m;
  }

  void searchTile(int column, int row) {
    const std::size_t in_tiles = tiles_.tileAt(column, row);
    const int u = column * kEdge_px;
    const int v = row * kEdge_px;
    const std::size_t in_image = s_.view.image().grid().tileAt(u, v);
    const Tile tile{camera_.rayTiles().x(in_image),
                    camera_.rayTiles().y(in_image),
                    s_.view.image().tiles()[in_image],
                    {u, std::min(u + kEdge_px, camera_.width()) - 1, v, std::min(v + kEdge_px, camera_.height()) - 1},
                    tiles_.hasGap(in_tiles) ? placesOf(tiles_.gaps()[in_tiles]) : 0};
    if (tile.gaps != ~std::uint64_t{0}) searchReturns(tile);
    if (tile.gaps != 0 && !isEnough()) searchGaps(tile);
  }

  static std::uint64_t placesOf(const DepthTiles::Gaps& gaps) {
    std::uint64_t places = 0;
    for (std::size_t u = 0; u < gaps.size(); ++u) {
      for (std::uint32_t rows = gaps[u]; rows != 0; rows &= rows - 1) {
        places |= std::uint64_t{1} << TileGrid::placeInTile(static_cast<int>(u), std::countr_zero(rows));
      }
    }
    return places;
  }

  void searchReturns(const Tile& tile) {
    const FloatTag d;
    alignas(64) std::array<float, TileGrid::kTilePixels> begin_m;
    for (std::size_t i = 0; i < begin_m.size(); ++i) begin_m[i] = camera_.depth(tile.pixels.raw[i]);
    for (std::uint64_t rest = tile.gaps; rest != 0; rest &= rest - 1) {
      begin_m[static_cast<std::size_t>(std::countr_zero(rest))] = kNowhere_m;
    }
    for (std::size_t i = 0; i < TileGrid::kTilePixels; i += kLanes) {
      const FloatVec squares = squaresOf(tile, i, hn::Load(d, &begin_m[i]));
      const FloatVec limit = hn::Set(d, least_sq_m2_);
      const auto nearer = hn::Lt(squares, limit);  // never what lies outside the image: it may be no number
      if (hn::AllFalse(d, nearer)) continue;
      const float least = leastLane(hn::IfThenElse(nearer, squares, limit));
      const auto lane = static_cast<std::size_t>(std::countr_zero(bitsOf(hn::Eq(squares, hn::Set(d, least)))));
      setNearest(tile, i + lane, begin_m[i + lane], least);
    }
  }

  void searchGaps(const Tile& tile) {
    const FloatTag d;
    alignas(64) std::array<float, TileGrid::kTilePixels> squares_m2;
    std::uint64_t within = 0;
    for (std::size_t i = 0; i < TileGrid::kTilePixels; i += kLanes) {
      const FloatVec squares = squaresOf(tile, i, hn::Set(d, near_m_));
      hn::Store(squares, d, &squares_m2[i]);
      within |= std::uint64_t{bitsOf(hn::Lt(squares, hn::Set(d, least_sq_m2_)))} << i;
    }
    within &= tile.gaps;
    if (within == 0) return;
    if (isOpen(s_.view, tile.rect, static_cast<double>(s_.p_C.z()), s_.up_C.cast<double>(), s_.options)) return;

    // The nearest first: in a wide gap it is what all others come after.
    auto nearest = static_cast<std::size_t>(std::countr_zero(within));
    for (std::uint64_t rest = within & (within - 1); rest != 0; rest &= rest - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(rest));
      if (squares_m2[place] < squares_m2[nearest]) nearest = place;
    }
    const GapsOfTile gaps(s_.view, tile.rect.u_min / kEdge_px, tile.rect.v_min / kEdge_px);
    searchGap(tile, gaps, nearest);
    within &= ~(std::uint64_t{1} << nearest);
    for (; within != 0 && !isEnough(); within &= within - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(within));
      if (squares_m2[place] < least_sq_m2_) searchGap(tile, gaps, place);
    }
  }

  void searchGap(const Tile& tile, const GapsOfTile& gaps, std::size_t place) {
    const CameraModel::Pixel pixel{tile.rect.u_min + static_cast<int>(place) % kEdge_px,
                                   tile.rect.v_min + static_cast<int>(place) / kEdge_px};
    const float begin_m = gaps.narrowDepth_m(pixel, s_.options.narrow_gap_px).value_or(near_m_);
    const float square_m2 = distance_.square_m2(tile.tan_x.tangents[place], tile.tan_y.tangents[place], begin_m);
    if (square_m2 < least_sq_m2_) setNearest(tile, place, begin_m, square_m2);
  }

  HWY_INLINE FloatVec squaresOf(const Tile& tile, std::size_t first, FloatVec begin_m) const {
    const FloatTag d;
    return distance_.squares_m2(hn::Load(d, &tile.tan_x.tangents[first]), hn::Load(d, &tile.tan_y.tangents[first]),
                                begin_m);
  }

  void setNearest(const Tile& tile, std::size_t place, float begin_m, float square_m2) {
    const float tan_x = tile.tan_x.tangents[place];
    const float tan_y = tile.tan_y.tangents[place];
    least_sq_m2_ = square_m2;
    at_C_ = distance_.nearestDepth_m(tan_x, tan_y, begin_m) * Vec3f(tan_x, tan_y, 1.0F);
  }

  /// Beyond everything, with a square that is finite.
  static constexpr float kNowhere_m = 1e18F;

  const UnseenSearch& s_;
  const CameraModel& camera_;
  const DepthTiles& tiles_;
  RayDistance distance_;
  float near_m_;
  float slack_m2_;  ///< of a tile's bound
  float enough_sq_m2_;
  float least_sq_m2_;
  std::optional<Vec3f> at_C_;
};

NearestUnseen findNearestUnseen(const UnseenSearch& search) { return BallSearch(search).run(); }

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(findNearestUnseen);

NearestUnseen nearestUnseen(const UnseenSearch& search) { return HWY_DYNAMIC_DISPATCH(findNearestUnseen)(search); }

}  // namespace nanomap
#endif
