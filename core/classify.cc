#include "core/classify.h"

#include <algorithm>
#include <cmath>

#include "core/open_sky.h"
#include "core/return_search.h"

namespace nanomap {
namespace {

/// Does a return in the box's pixel footprint lie in front of the box's far face? @pre the box is in the frustum
bool occludesBox(const View& view, const Vec3& mean_C, const Vec3& half_size_C) {
  const double near_z_m = mean_C.z() - half_size_C.z();
  const double far_z_m = mean_C.z() + half_size_C.z();
  if (!(near_z_m > 0.0)) return true;
  // A tangent is extreme at the near face where it points away from the axis, else at the far face.
  const auto lowest = [&](double low) { return low / (low < 0.0 ? near_z_m : far_z_m); };
  const auto highest = [&](double high) { return high / (high > 0.0 ? near_z_m : far_z_m); };
  const Vec3 low = mean_C - half_size_C;
  const Vec3 high = mean_C + half_size_C;
  const Frustum& frustum = view.camera().frustum();
  const auto clampX = [&](double tangent) { return std::clamp(tangent, frustum.tan_left, frustum.tan_right); };
  const auto clampY = [&](double tangent) { return std::clamp(tangent, frustum.tan_top, frustum.tan_bottom); };
  const double tan_x[] = {clampX(lowest(low.x())), clampX(highest(high.x()))};
  const double tan_y[] = {clampY(lowest(low.y())), clampY(highest(high.y()))};
  PixelRect footprint{view.camera().width() - 1, 0, view.camera().height() - 1, 0};
  for (const double x : tan_x) {
    for (const double y : tan_y) {
      const CameraModel::Pixel corner = *view.camera().pixelAt(x, y);
      footprint = {std::min(footprint.u_min, corner.u), std::max(footprint.u_max, corner.u),
                   std::min(footprint.v_min, corner.v), std::max(footprint.v_max, corner.v)};
    }
  }
  return hasReturnWithin(view, footprint, far_z_m, ImageLevel{});
}

/// diag(R * Sigma * R^T) without the rest of it: all that the containment test needs.
Vec3 rotatedDiagonal(const Mat3& R, const Mat3& covariance_m2) {
  const Mat3& s = covariance_m2;
  // Written out: a product of matrices goes through memory, and is read back in other parts than it was written in.
  const auto along = [&](Eigen::Index axis) {
    const double x = R(axis, 0);
    const double y = R(axis, 1);
    const double z = R(axis, 2);
    return x * (x * s(0, 0) + y * (s(0, 1) + s(1, 0)) + z * (s(0, 2) + s(2, 0))) +
           y * (y * s(1, 1) + z * (s(1, 2) + s(2, 1))) + z * z * s(2, 2);
  };
  return {along(0), along(1), along(2)};
}

/// `half_size()` is asked for only where the box matters.
template <class HalfSize>
Status classifyLazily(const View& view, const Vec3& mean_C_m, const Vec3& up_C, const QueryOptions& options,
                      HalfSize&& half_size) {
  const CameraModel& camera = view.camera();
  const Frustum& frustum = camera.frustum();
  const double z_m = mean_C_m.z();
  if (!(z_m >= frustum.near_m && z_m > 0.0)) return Status::kBehind;
  const auto pixel = camera.pixelAt(mean_C_m.x() / z_m, mean_C_m.y() / z_m);
  if (!pixel) return Status::kOutsideFov;
  if (!(z_m <= frustum.far_m)) return Status::kBeyondRange;

  const std::uint16_t raw = view.rawAt(pixel->u, pixel->v);
  if (camera.classify(raw) == DepthReading::kNone) {
    if (!isOpen(view, PixelRect::of(*pixel), z_m, up_C, options)) return Status::kHole;
    return contains(frustum, mean_C_m, half_size().array() + options.margin_m) ? Status::kOpen : Status::kPartial;
  }
  if (z_m >= static_cast<double>(camera.depth(raw))) return Status::kOccluded;
  const Vec3 half_size_C_m = half_size();
  if (!contains(frustum, mean_C_m, half_size_C_m.array() + options.margin_m)) return Status::kPartial;
  if (options.occlusion == OcclusionTest::kFootprint && occludesBox(view, mean_C_m, half_size_C_m)) {
    return Status::kPartial;
  }
  return Status::kFree;
}

}  // namespace

bool contains(const Frustum& frustum, const Vec3& mean_C_m, const Vec3& half_size_C_m) {
  const auto side = [&](int axis, double tangent, double sign) {
    const double distance = sign * (mean_C_m[axis] - tangent * mean_C_m.z());
    return distance >= half_size_C_m[axis] + std::abs(tangent) * half_size_C_m.z();
  };
  return side(0, frustum.tan_left, 1.0) && side(0, frustum.tan_right, -1.0) &&  //
         side(1, frustum.tan_top, 1.0) && side(1, frustum.tan_bottom, -1.0) &&  //
         mean_C_m.z() - half_size_C_m.z() >= frustum.near_m && mean_C_m.z() + half_size_C_m.z() <= frustum.far_m;
}

Status classify(const View& view, const Vec3& mean_C_m, const Vec3& half_size_C_m, const Vec3& up_C,
                const QueryOptions& options) {
  return classifyLazily(view, mean_C_m, up_C, options, [&]() -> const Vec3& { return half_size_C_m; });
}

Status classify(const SnapshotView& candidate, const UncertainPoint& x_B, const QueryOptions& options) {
  const Vec3 mean_C = candidate.R_C_B * x_B.mean_m + candidate.t_C_B_m;
  return classifyLazily(*candidate.view, mean_C, candidate.up_C, options, [&]() -> Vec3 {
    const Vec3 variance_C =
        candidate.edge_covariance_C_m2.diagonal() + rotatedDiagonal(candidate.R_C_B, x_B.covariance_m2);
    return variance_C.cwiseMax(0.0).cwiseSqrt();
  });
}

}  // namespace nanomap
