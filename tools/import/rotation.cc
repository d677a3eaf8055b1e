#include "tools/import/rotation.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

namespace nanomap {
namespace {

/// A hundred times the rounding that recordings carry, and still half a degree: more is another matrix.
constexpr double kMaxError = 0.01;

}  // namespace

Quat nearestRotation(const Mat3& R) {
  if (!R.allFinite()) throw std::invalid_argument("the rotation is not finite");
  const Eigen::JacobiSVD<Mat3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3 nearest = svd.matrixU() * svd.matrixV().transpose();
  if (nearest.determinant() < 0.0) {
    throw std::invalid_argument("the upper left 3x3 mirrors (determinant -1): not a rotation");
  }
  const double error = (nearest - R).cwiseAbs().maxCoeff();
  if (error > kMaxError) {
    throw std::invalid_argument(fmt::format("the upper left 3x3 is not a rotation: off by {:.3g} in an entry", error));
  }
  return Quat(nearest).normalized();
}

Quat unitQuaternion(const Quat& q) {
  const double norm = q.norm();
  if (!std::isfinite(norm) || std::abs(norm - 1.0) > kMaxError) {
    throw std::invalid_argument(fmt::format("the quaternion has norm {:.6g}, not 1", norm));
  }
  return q.normalized();
}

}  // namespace nanomap
