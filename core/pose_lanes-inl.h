// Poses as vector code takes them, many at a time, for each instruction set anew. After core/simd.h and Highway.
#if defined(NANOMAP_CORE_POSE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NANOMAP_CORE_POSE_LANES_INL_H_
#undef NANOMAP_CORE_POSE_LANES_INL_H_
#else
#define NANOMAP_CORE_POSE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

#include "core/geometry.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using PoseTag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<PoseTag>;

constexpr std::size_t kPoseLanes = hn::MaxLanes(PoseTag());

// Products and sums are never fused, so that every instruction set rounds alike.

struct Vectors {
  Lanes x, y, z;
};
struct Rotations {
  Lanes x, y, z, w;
};
struct Poses {
  Rotations rotation;
  Vectors translation_m;
};

HWY_INLINE Lanes all(double value) { return hn::Set(PoseTag(), value); }

HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Vectors operator*(Lanes s, const Vectors& a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

HWY_INLINE Rotations operator+(const Rotations& a, const Rotations& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
HWY_INLINE Rotations operator*(Lanes s, const Rotations& a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
HWY_INLINE Rotations operator*(const Rotations& a, const Rotations& b) {
  return {(a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y), (a.w * b.y + a.y * b.w) + (a.z * b.x - a.x * b.z),
          (a.w * b.z + a.z * b.w) + (a.x * b.y - a.y * b.x), (a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z)};
}
HWY_INLINE Lanes dot(const Rotations& a, const Rotations& b) {
  return (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
}
HWY_INLINE Rotations conjugate(const Rotations& a) { return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z), a.w}; }
HWY_INLINE Rotations normalized(const Rotations& a) { return (all(1.0) / hn::Sqrt(dot(a, a))) * a; }
/// As core/geometry.h.
HWY_INLINE Rotations unitAgain(const Rotations& a) { return (all(1.5) - all(0.5) * dot(a, a)) * a; }
HWY_INLINE Rotations choose(hn::Mask<PoseTag> first, const Rotations& a, const Rotations& b) {
  return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y), hn::IfThenElse(first, a.z, b.z),
          hn::IfThenElse(first, a.w, b.w)};
}

HWY_INLINE Vectors rotate(const Rotations& R, const Vectors& v) {
  const Vectors axis{R.x, R.y, R.z};
  const Vectors half = cross(axis, v);
  const Vectors turn = half + half;
  return v + R.w * turn + cross(axis, turn);
}

/// What a slerp multiplies the end of that weight with, for x = 1 - cos(angle): the series of core/slerp.h.
HWY_INLINE Lanes shareOf(Lanes weight, Lanes x) {
  const Lanes w2 = weight * weight;
  const auto b = [&w2](double i) HWY_ATTR { return all(i / (2.0 * i + 1.0)) - w2 * all(1.0 / (i * (2.0 * i + 1.0))); };
  const Lanes one = all(1.0);
  return weight * (one + x * b(1.0) * (one + x * b(2.0) * (one + x * b(3.0) * (one + x * b(4.0)))));
}

/// Shortest-arc slerp, as core/slerp.h but for arcs too wide for the series: they are halved, and the half taken that
/// holds the result, until none is too wide; the widest, of a half turn, five times.
HWY_INLINE Rotations slerp(Rotations from, Rotations to, Lanes weight) {
  constexpr int kMostHalvings = 5;
  const Lanes one = all(1.0);
  Lanes cosine = dot(from, to);
  for (int i = 0; i < kMostHalvings; ++i) {
    const auto wide = hn::Gt(one - hn::Abs(cosine), all(kGreatestCosineGap));
    if (hn::AllFalse(PoseTag(), wide)) break;
    const Rotations middle = normalized(from + hn::CopySign(one, cosine) * to);
    const auto behind = hn::Ge(weight, all(0.5));
    from = choose(hn::And(wide, behind), middle, from);
    to = choose(hn::AndNot(behind, wide), middle, to);
    const Lanes twice = weight + weight;
    weight = hn::IfThenElse(wide, hn::IfThenElse(behind, twice - one, twice), weight);
    cosine = dot(from, to);
  }
  const Lanes x = one - hn::Abs(cosine);
  return shareOf(one - weight, x) * from + hn::CopySign(shareOf(weight, x), cosine) * to;
}

HWY_INLINE Poses interpolate(const Poses& from, const Poses& to, Lanes weight) {
  return {slerp(from.rotation, to.rotation, weight),
          from.translation_m + weight * (to.translation_m - from.translation_m)};
}

/// Two doubles from each second place, from the first on, one pair behind the other.
template <class D>
HWY_INLINE hn::Vec<D> loadPairs(D d, const double* const* places) {
  if constexpr (hn::MaxLanes(D()) == 2) {
    return hn::LoadU(d, places[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, loadPairs(half, places + hn::MaxLanes(half)), loadPairs(half, places));
  }
}
template <class D>
HWY_INLINE void storePairs(D d, hn::Vec<D> pairs, double* const* places) {
  if constexpr (hn::MaxLanes(D()) == 2) {
    hn::StoreU(pairs, d, places[0]);
  } else {
    const hn::Half<D> half;
    storePairs(half, hn::LowerHalf(half, pairs), places);
    storePairs(half, hn::UpperHalf(half, pairs), places + hn::MaxLanes(half));
  }
}

/// From each place two doubles that follow each other: the first ones and the second ones.
struct TwoColumns {
  Lanes first, second;
};
template <class Place>
HWY_INLINE TwoColumns loadColumns(const std::array<const Pose*, kPoseLanes>& poses, Place&& place) {
  std::array<const double*, kPoseLanes> places;
  for (std::size_t i = 0; i < kPoseLanes; ++i) places[i] = place(*poses[i]);
  const Lanes even = loadPairs(PoseTag(), places.data());
  const Lanes odd = loadPairs(PoseTag(), places.data() + 1);
  return {hn::InterleaveLower(PoseTag(), even, odd), hn::InterleaveUpper(PoseTag(), even, odd)};
}
template <class Place>
HWY_INLINE void storeColumns(const TwoColumns& columns, const std::array<Pose*, kPoseLanes>& poses, Place&& place) {
  std::array<double*, kPoseLanes> places;
  for (std::size_t i = 0; i < kPoseLanes; ++i) places[i] = place(*poses[i]);
  storePairs(PoseTag(), hn::InterleaveLower(PoseTag(), columns.first, columns.second), places.data());
  storePairs(PoseTag(), hn::InterleaveUpper(PoseTag(), columns.first, columns.second), places.data() + 1);
}

HWY_INLINE Poses load(const std::array<const Pose*, kPoseLanes>& poses) {
  const TwoColumns xy = loadColumns(poses, [](const Pose& p) { return p.rotation.coeffs().data(); });
  const TwoColumns zw = loadColumns(poses, [](const Pose& p) { return p.rotation.coeffs().data() + 2; });
  const TwoColumns t_xy = loadColumns(poses, [](const Pose& p) { return p.translation_m.data(); });
  const TwoColumns t_yz = loadColumns(poses, [](const Pose& p) { return p.translation_m.data() + 1; });
  return {{xy.first, xy.second, zw.first, zw.second}, {t_xy.first, t_xy.second, t_yz.second}};
}

HWY_INLINE void store(const Poses& lanes, const std::array<Pose*, kPoseLanes>& poses) {
  const Rotations& r = lanes.rotation;
  const Vectors& t = lanes.translation_m;
  storeColumns({r.x, r.y}, poses, [](Pose& p) { return p.rotation.coeffs().data(); });
  storeColumns({r.z, r.w}, poses, [](Pose& p) { return p.rotation.coeffs().data() + 2; });
  storeColumns({t.x, t.y}, poses, [](Pose& p) { return p.translation_m.data(); });
  storeColumns({t.y, t.z}, poses, [](Pose& p) { return p.translation_m.data() + 1; });
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
