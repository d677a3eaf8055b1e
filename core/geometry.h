#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/slerp.h"

namespace nanomap {

using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// How far the norm of a given quaternion may be off 1: orientations pass through single precision and text in places;
/// more than that is a fault.
inline constexpr double kUnitNormTolerance = 1e-3;

/// Rigid transform. A variable of this type is named `T_A_B`: it maps a point given in B to A,
/// `p_A = T_A_B * p_B`, and neighbouring letters meet in a product, `T_A_C = T_A_B * T_B_C`.
struct Pose {
  Quat rotation = Quat::Identity();   ///< unit quaternion, R_A_B
  Vec3 translation_m = Vec3::Zero();  ///< B's origin in A

  [[nodiscard]] Pose inverse() const {
    const Quat rotation_inverse = rotation.conjugate();
    return {rotation_inverse, -(rotation_inverse * translation_m)};
  }

  bool operator==(const Pose&) const = default;  ///< exact: a quaternion and its negative differ
};

/// What rounding took off a unit quaternion, put back: one Newton step for the norm, without root or division. An
/// error e of the norm becomes 1.5 e^2.
[[nodiscard]] inline Quat unitAgain(const Quat& nearly_unit) {
  return Quat((1.5 - 0.5 * nearly_unit.squaredNorm()) * nearly_unit.coeffs());
}

[[nodiscard]] inline Pose operator*(const Pose& T_A_B, const Pose& T_B_C) {
  return {unitAgain(T_A_B.rotation * T_B_C.rotation), T_A_B.rotation * T_B_C.translation_m + T_A_B.translation_m};
}

[[nodiscard]] inline Vec3 operator*(const Pose& T_A_B, const Vec3& p_B) {
  return T_A_B.rotation * p_B + T_A_B.translation_m;
}

/// T_A_B, from A and B in one frame W: T_A_W * T_W_B.
[[nodiscard]] inline Pose relativePose(const Pose& T_W_A, const Pose& T_W_B) {
  const Quat R_A_W = T_W_A.rotation.conjugate();
  return {unitAgain(R_A_W * T_W_B.rotation), R_A_W * (T_W_B.translation_m - T_W_A.translation_m)};
}

/// Linear in translation, shortest-arc slerp in rotation. `weight` 0 gives `from`, 1 gives `to`.
[[nodiscard]] inline Pose interpolate(const Pose& from, const Pose& to, double weight) {
  return {slerp(from.rotation, to.rotation, weight),
          from.translation_m + weight * (to.translation_m - from.translation_m)};
}

/// No less than the largest eigenvalue of a symmetric matrix (Gershgorin).
[[nodiscard]] inline double largestVarianceBound(const Mat3& covariance_m2) {
  return covariance_m2.cwiseAbs().rowwise().sum().maxCoeff();
}

/// A Gaussian point: mean [m] and covariance [m^2], both in the frame that ends the variable's name (`x_B`).
struct UncertainPoint {
  Vec3 mean_m = Vec3::Zero();
  Mat3 covariance_m2 = Mat3::Zero();
};

}  // namespace nanomap
