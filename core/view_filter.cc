#include "core/view_filter.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/open_sky.h"
#include "core/view_scan.h"

namespace nanomap {
namespace {

constexpr double kUnitRoundoff = 0x1p-24;
constexpr double kLengthRoundings = 64.0;
constexpr double kVarianceRoundings = 32.0;
/// Of a coordinate [m] or a covariance [m^2]: keeps squares far from overflow. Nothing within reason is larger.
constexpr double kLargest = 1e6;
/// What a slack loses when it is rounded to float, and what a depth in counts may gain.
constexpr double kRoundingUp = 1.0 + 0x1p-20;

/// Read in the lanes without a view.
constexpr DepthTiles::Cover kNoCover;

bool isWithin(const auto& matrix, double limit) { return (matrix.array().abs() <= limit).all(); }

bool isWithinReason(const SnapshotView& view) {
  constexpr double kLargestOfRotation = 1.0 + kUnitRoundoff;
  return isWithin(view.R_C_B, kLargestOfRotation) && isWithin(view.t_C_B_m, kLargest) &&
         isWithin(view.edge_covariance_C_m2, kLargest);
}

bool isWithinReason(const UncertainPoint& x_B) {
  return isWithin(x_B.mean_m, kLargest) && isWithin(x_B.covariance_m2, kLargest);
}

double largestTangent(const Frustum& frustum) {
  return std::max({std::abs(frustum.tan_left), std::abs(frustum.tan_right), std::abs(frustum.tan_top),
                   std::abs(frustum.tan_bottom)});
}

float rounded(double value) { return static_cast<float>(value); }

/// How many vectors of lanes hold so many.
std::size_t vectorsFor(std::size_t count) { return (count + kViewLanes - 1) / kViewLanes; }

void setLane(ViewLanes& lanes, std::size_t lane, const SnapshotView& view) {
  for (std::size_t row = 0; row < 3; ++row) {
    const auto axis = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column) {
      lanes.R_C_B[row][column][lane] = rounded(view.R_C_B(axis, static_cast<Eigen::Index>(column)));
    }
    lanes.t_C_B_m[row][lane] = rounded(view.t_C_B_m[axis]);
    lanes.edge_variance_C_m2[row][lane] = rounded(view.edge_covariance_C_m2(axis, axis));
  }
  const CameraModel& camera = view.view->camera();
  const Frustum& frustum = camera.frustum();
  lanes.tan_left[lane] = rounded(frustum.tan_left);
  lanes.tan_right[lane] = rounded(frustum.tan_right);
  lanes.tan_top[lane] = rounded(frustum.tan_top);
  lanes.tan_bottom[lane] = rounded(frustum.tan_bottom);
  lanes.near_m[lane] = rounded(frustum.near_m);
  lanes.far_m[lane] = rounded(frustum.far_m);
  lanes.cells_per_tan_x[lane] = rounded(camera.width() / (frustum.tan_right - frustum.tan_left));
  lanes.cells_per_tan_y[lane] = rounded(camera.height() / (frustum.tan_bottom - frustum.tan_top));
  lanes.last_column[lane] = static_cast<float>(camera.width() - 1);
  lanes.last_row[lane] = static_cast<float>(camera.height() - 1);
  lanes.counts_per_m[lane] = rounded(1.0 / (static_cast<double>(camera.depth(1)) * kRoundingUp));
  lanes.tile_columns[lane] = view.view->tiles().columns();
  lanes.cover[lane] = view.view->tiles().cover().data();
  lanes.view[lane] = view.view.get();
  if (camera.parameters().distortion.isZero()) lanes.tiled |= 1U << lane;
  if (liesBelowGlance(view.up_C)) lanes.upright |= 1U << lane;
}

ViewLanes withoutViews() {
  ViewLanes lanes{};
  lanes.near_m.fill(std::numeric_limits<float>::infinity());
  lanes.cover.fill(&kNoCover);
  return lanes;
}

/// How far inside each plane of a view's frustum a point p_B is, times the length of the plane's normal, is the product
/// of a column and (p_B, 1).
using PlanesOfView = Eigen::Matrix<double, 4, BlockLanes::kPlanes>;

PlanesOfView planesOf(const SnapshotView& view) {
  const Frustum& frustum = view.view->camera().frustum();
  Eigen::Matrix<double, 4, 3> T_C_B;  // coordinates, as columns
  T_C_B << view.R_C_B.transpose(), view.t_C_B_m.transpose();
  const Eigen::Vector4d z = T_C_B.col(2);
  PlanesOfView planes;
  planes << T_C_B.col(0) - frustum.tan_left * z, frustum.tan_right * z - T_C_B.col(0),
      T_C_B.col(1) - frustum.tan_top * z, frustum.tan_bottom * z - T_C_B.col(1),
      z - frustum.near_m * Eigen::Vector4d::UnitW(), frustum.far_m * Eigen::Vector4d::UnitW() - z;
  return planes;
}

void setLane(BlockLanes& lanes, std::size_t lane, std::span<const SnapshotView> block) {
  PlanesOfView least = planesOf(block.front());
  PlanesOfView greatest = least;
  for (const SnapshotView& view : block.subspan(1)) {
    const PlanesOfView planes = planesOf(view);
    least = least.cwiseMin(planes);
    greatest = greatest.cwiseMax(planes);
  }
  for (std::size_t i = 0; i < BlockLanes::kPlanes; ++i) {
    const auto plane = static_cast<Eigen::Index>(i);
    const Eigen::Vector4d middle = (least.col(plane) + greatest.col(plane)) / 2.0;
    const Eigen::Vector4d spread = (greatest.col(plane) - least.col(plane)) / 2.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lanes.planes[i].normal_B[axis][lane] = rounded(middle[static_cast<Eigen::Index>(axis)]);
      lanes.planes[i].spread_B[axis][lane] = rounded(spread[static_cast<Eigen::Index>(axis)]);
    }
    lanes.planes[i].offset_m[lane] = rounded(greatest(3, plane));
  }
}

BlockLanes withoutBlocks() {
  BlockLanes lanes{};
  for (BlockLanes::Plane& plane : lanes.planes) plane.offset_m.fill(-std::numeric_limits<float>::infinity());
  return lanes;
}

}  // namespace

void ViewFilter::assign(std::span<const SnapshotView> views) {
  groups_.clear();
  blocks_.clear();
  reach_m_ = 0.0;
  largest_tangent_ = 0.0;
  largest_edge_variance_m2_ = 0.0;
  if (!std::ranges::all_of(views, [](const SnapshotView& view) { return isWithinReason(view); })) return;
  blocks_.resize(vectorsFor(views.size()), withoutViews());
  groups_.resize(vectorsFor(blocks_.size()), withoutBlocks());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SnapshotView& view = views[i];
    setLane(blocks_[i / kViewLanes], i % kViewLanes, view);
    reach_m_ = std::max(reach_m_, view.t_C_B_m.norm());
    largest_tangent_ = std::max(largest_tangent_, largestTangent(view.view->camera().frustum()));
    largest_edge_variance_m2_ = std::max(largest_edge_variance_m2_, view.edge_covariance_C_m2.diagonal().maxCoeff());
  }
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const auto from_block = views.subspan(i * kViewLanes);
    setLane(groups_[i / kViewLanes], i % kViewLanes, from_block.first(std::min(from_block.size(), kViewLanes)));
  }
}

ViewFilter::Walk::Walk(const ViewFilter& filter, std::size_t view_count, const UncertainPoint& x_B,
                       const QueryOptions& options, std::uint32_t first)
    : options_(options), view_count_(static_cast<std::uint32_t>(view_count)), first_(first) {
  assert(filter.empty() || filter.blocks_.size() == vectorsFor(view_count));
  if (filter.empty() || !isWithinReason(x_B) || !(options.margin_m >= 0.0 && options.margin_m <= kLargest)) return;
  groups_ = filter.groups_;
  blocks_ = filter.blocks_;
  const Mat3& s = x_B.covariance_m2;
  const double variances_m2 = filter.largest_edge_variance_m2_ + s.norm();
  const double lengths_m = x_B.mean_m.norm() + filter.reach_m_ + std::sqrt(variances_m2) + options.margin_m;
  const double roundoff = kUnitRoundoff * kRoundingUp;
  probe_.mean_B_m = {rounded(x_B.mean_m.x()), rounded(x_B.mean_m.y()), rounded(x_B.mean_m.z())};
  probe_.covariance_B_m2 = {rounded(s(0, 0)),
                            rounded(s(1, 1)),
                            rounded(s(2, 2)),
                            rounded(0.5 * (s(0, 1) + s(1, 0))),
                            rounded(0.5 * (s(0, 2) + s(2, 0))),
                            rounded(0.5 * (s(1, 2) + s(2, 1)))};
  probe_.slack_m = rounded(kLengthRoundings * roundoff * lengths_m * (1.0 + filter.largest_tangent_));
  probe_.margin_m = rounded(options.margin_m);
  probe_.slack_m2 = rounded(kVarianceRoundings * roundoff * variances_m2);
}

std::optional<std::uint32_t> ViewFilter::Walk::next() {
  if (blocks_.empty()) return first_ < view_count_ ? std::optional(first_++) : std::nullopt;
  for (;;) {
    if (probed_.left == 0 && !scanViews(groups_, blocks_, probe_, probed_)) return std::nullopt;
    lane_ = static_cast<std::uint32_t>(std::countr_zero(probed_.left));
    probed_.left &= probed_.left - 1;
    const auto view_index = static_cast<std::uint32_t>(probed_.block * kViewLanes) + lane_;
    if (view_index >= first_ && !isOccluded(blocks_[probed_.block], lane_)) return view_index;
  }
}

/// Is the mean certainly not nearer than the depth that its pixel carries?
bool ViewFilter::Walk::isOccluded(const ViewLanes& lanes, std::uint32_t lane) const {
  if ((probed_.in_cell >> lane & 1U) == 0) return false;
  const View& view = *lanes.view[lane];
  const CameraModel::Pixel pixel = view.camera().pixelOfCell({probed_.column[lane], probed_.row[lane]});
  const std::uint16_t raw = view.rawAt(pixel.u, pixel.v);
  return probed_.raw[lane] >= raw && view.camera().classify(raw) != DepthReading::kNone;
}

bool ViewFilter::Walk::isBeforeHole() const {
  if (blocks_.empty()) return false;
  const ViewLanes& lanes = blocks_[probed_.block];
  if ((probed_.in_cell & lanes.upright & 1U << lane_) == 0) return false;
  const View& view = *lanes.view[lane_];
  const CameraModel::Pixel pixel = view.camera().pixelOfCell({probed_.column[lane_], probed_.row[lane_]});
  const std::uint16_t raw = view.rawAt(pixel.u, pixel.v);
  return view.camera().classify(raw) == DepthReading::kNone && isHoleAtGlance(view, pixel, options_);
}

}  // namespace nanomap
