#include "core/vouched_ball.h"

#include <algorithm>
#include <cmath>

#include "core/unseen_search.h"

namespace nanomap {
namespace {

/// Distance from the nearest plane of a frustum [m]; negative outside.
double depthInside_m(const Frustum& frustum, const Vec3& p_C) {
  const auto side = [&](int axis, double tangent, double sign) {
    return sign * (p_C[axis] - tangent * p_C.z()) / std::sqrt(1.0 + tangent * tangent);
  };
  return std::min({side(0, frustum.tan_left, 1.0), side(0, frustum.tan_right, -1.0),  //
                   side(1, frustum.tan_top, 1.0), side(1, frustum.tan_bottom, -1.0),  //
                   p_C.z() - frustum.near_m, frustum.far_m - p_C.z()});
}

/// What is hidden by a ray may reach up to the next one: at depth z, z times the tangent between the two. In a ball
/// around p, z is at most p_z and the radius.
class PixelMargin {
 public:
  PixelMargin(const CameraModel& camera, const Vec3& p_C, double largest_m)
      : tangent_(camera.tileTangents().pixel()), aside_m_(tangent_ * p_C.z() + kRounding * (p_C.norm() + largest_m)) {}

  /// How far unseen rays must stay away from a ball's middle, so that nothing up to the next ray is in the ball.
  [[nodiscard]] double toRays(double radius_m) const { return radius_m * (1.0 + tangent_) + aside_m_; }
  [[nodiscard]] double fromRays(double distance_m) const { return (distance_m - aside_m_) / (1.0 + tangent_); }

 private:
  /// Above the errors of single precision in a distance, as a part of the lengths that it is made of.
  static constexpr double kRounding = 0x1p-19;

  double tangent_;
  double aside_m_;
};

}  // namespace

VouchedBall vouchedBall(const View& view, const Vec3& p_C, const Vec3& up_C, const QueryOptions& options,
                        const RadiiOfInterest& of_interest, const std::optional<Vec3>& look_first_C) {
  const double inside_m = std::min(depthInside_m(view.camera().frustum(), p_C), of_interest.limit_m);
  if (!(inside_m > of_interest.above_m)) return {};
  const PixelMargin margin(view.camera(), p_C, inside_m);
  UnseenSearch search{.view = view,
                      .p_C = p_C.cast<float>(),
                      .up_C = up_C.cast<float>(),
                      .options = options,
                      .radius_m = static_cast<float>(margin.toRays(inside_m)),
                      .enough_m = static_cast<float>(margin.toRays(of_interest.above_m)),
                      .look_first_C = {}};
  if (look_first_C) search.look_first_C = look_first_C->cast<float>();
  const NearestUnseen unseen = nearestUnseen(search);

  VouchedBall ball;
  double radius_m = inside_m;
  if (unseen.at_C) {
    ball.nearest_unseen_C = unseen.at_C->cast<double>();
    radius_m = std::min(margin.fromRays(static_cast<double>(unseen.distance_m)), inside_m);
  }
  if (radius_m > of_interest.above_m) ball.radius_m = radius_m;
  return ball;
}

}  // namespace nanomap
