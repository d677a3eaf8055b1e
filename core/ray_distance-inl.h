// For each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_RAY_DISTANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_RAY_DISTANCE_INL_H_
#undef NANOMAP_CORE_RAY_DISTANCE_INL_H_
#else
#define NANOMAP_CORE_RAY_DISTANCE_INL_H_
#endif

#include <algorithm>

#include "core/geometry.h"
#include "core/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// How far a point is from rays through the camera's centre, each given by its tangents (x/z, y/z) and the depth [m]
/// that the part of interest begins at. In float arithmetic without fused operations: the same on every target.
class RayDistance {
 public:
  /// @pre p_C.z() > 0
  HWY_INLINE explicit RayDistance(const Vec3f& p_C) : p_C_(p_C) {}

  /// The depth at which a ray is nearest.
  [[nodiscard]] float nearestDepth_m(float tan_x, float tan_y, float begin_m) const {
    const float along_m = tan_x * p_C_.x() + tan_y * p_C_.y() + p_C_.z();
    return std::max(begin_m, along_m / (tan_x * tan_x + tan_y * tan_y + 1.0F));
  }

  [[nodiscard]] float square_m2(float tan_x, float tan_y, float begin_m) const {
    const float z_m = nearestDepth_m(tan_x, tan_y, begin_m);
    const float dx_m = tan_x * z_m - p_C_.x();
    const float dy_m = tan_y * z_m - p_C_.y();
    const float dz_m = z_m - p_C_.z();
    return dx_m * dx_m + dy_m * dy_m + dz_m * dz_m;
  }

  /// The same of as many rays as a vector has lanes.
  HWY_INLINE FloatVec squares_m2(FloatVec tan_x, FloatVec tan_y, FloatVec begin_m) const {
    const FloatTag d;
    const FloatVec x = hn::Set(d, p_C_.x());
    const FloatVec y = hn::Set(d, p_C_.y());
    const FloatVec z = hn::Set(d, p_C_.z());
    const FloatVec along = hn::Add(hn::Add(hn::Mul(tan_x, x), hn::Mul(tan_y, y)), z);
    const FloatVec at_z = hn::Max(begin_m, hn::Div(along, normSquared(tan_x, tan_y)));
    return sumOfSquares(hn::Sub(hn::Mul(tan_x, at_z), x), hn::Sub(hn::Mul(tan_y, at_z), y), hn::Sub(at_z, z));
  }

  /// Tangents of many rays, between which they lie.
  struct Tangents {
    FloatVec least;
    FloatVec greatest;
  };

  /// Above what rounding can add to a bound, or take off what it bounds, for squares up to `largest_m2`.
  [[nodiscard]] float boundSlack_m2(float largest_m2) const {
    constexpr float kRoundings = 0x1p-19F;
    return kRoundings * (p_C_.squaredNorm() + largest_m2);
  }

  /// No more than the square of any ray whose tangents lie in `x` and `y`, but for rounding: a lane a bundle of rays.
  ///
  /// At depth z the nearest of them is f(z) = |x - clamp(x, rays)|^2 + |y - clamp(y, rays)|^2 + (z - p_z)^2 away, a
  /// convex function, piecewise a parabola. Newton's method finds its minimum in as many steps as pieces are crossed;
  /// f'' >= 2 bounds what is left if it ends sooner: f'^2 / 4.
  HWY_INLINE FloatVec boundOfBundles_m2(const Tangents& x, const Tangents& y, FloatVec begin_m) const {
    constexpr int kSteps = 2;
    const FloatTag d;
    const FloatVec p_z = hn::Set(d, p_C_.z());
    FloatVec z = hn::Max(p_z, begin_m);
    for (int step = 0;; ++step) {
      const Aside aside_x = aside(hn::Set(d, p_C_.x()), x, z);
      const Aside aside_y = aside(hn::Set(d, p_C_.y()), y, z);
      const FloatVec dz = hn::Sub(z, p_z);
      const FloatVec half_slope =
          hn::Add(hn::Add(hn::Mul(aside_x.tangent, aside_x.distance), hn::Mul(aside_y.tangent, aside_y.distance)), dz);
      if (step < kSteps) {
        const FloatVec newton = hn::Div(half_slope, normSquared(aside_x.tangent, aside_y.tangent));
        z = hn::Max(hn::Sub(z, newton), begin_m);
        continue;
      }
      const auto is_minimum = hn::And(hn::Le(z, begin_m), hn::Ge(half_slope, hn::Zero(d)));
      const FloatVec left = hn::IfThenZeroElse(is_minimum, hn::Mul(half_slope, half_slope));
      return hn::Sub(sumOfSquares(aside_x.distance, aside_y.distance, dz), left);
    }
  }

 private:
  /// How far a bundle is to the side of the point, with a sign, and the tangent of the ray that is nearest; zeros if it
  /// is to both sides.
  struct Aside {
    FloatVec distance;
    FloatVec tangent;
  };
  static HWY_INLINE Aside aside(FloatVec p, const Tangents& rays, FloatVec z) {
    const FloatVec zero = hn::Zero(FloatTag());
    const FloatVec beyond = hn::Max(hn::Sub(hn::Mul(rays.least, z), p), zero);
    const FloatVec before = hn::Min(hn::Sub(hn::Mul(rays.greatest, z), p), zero);
    const FloatVec nearest_before = hn::IfThenElseZero(hn::Lt(before, zero), rays.greatest);
    return {hn::Add(beyond, before), hn::IfThenElse(hn::Gt(beyond, zero), rays.least, nearest_before)};
  }

  static HWY_INLINE FloatVec sumOfSquares(FloatVec x, FloatVec y, FloatVec z) {
    return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
  }
  static HWY_INLINE FloatVec normSquared(FloatVec tan_x, FloatVec tan_y) {
    return sumOfSquares(tan_x, tan_y, hn::Set(FloatTag(), 1.0F));
  }

  Vec3f p_C_;
};

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
