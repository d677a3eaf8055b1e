#include "tools/import/rotation.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace nanomap {
namespace {

const Mat3 kTurned = (Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized())).toRotationMatrix();

TEST(NearestRotation, KeepsRotation) {
  EXPECT_LT((nearestRotation(kTurned).toRotationMatrix() - kTurned).norm(), 1e-14);
}

TEST(NearestRotation, RepairsRounding) {
  const Mat3 rounded = (kTurned * 1e4).array().round() / 1e4;
  const Quat repaired = nearestRotation(rounded);
  EXPECT_NEAR(repaired.norm(), 1.0, 1e-15);
  EXPECT_LT((repaired.toRotationMatrix() - kTurned).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(NearestRotation, RefusesScaledMatrix) {
  EXPECT_THROW((void)nearestRotation(1.05 * kTurned), std::invalid_argument);
}

TEST(NearestRotation, RefusesMirror) {
  EXPECT_THROW((void)nearestRotation(kTurned * Vec3(1.0, 1.0, -1.0).asDiagonal()), std::invalid_argument);
}

TEST(NearestRotation, RefusesZeroAndNonFinite) {
  EXPECT_THROW((void)nearestRotation(Mat3::Zero()), std::invalid_argument);
  EXPECT_THROW((void)nearestRotation(Mat3::Constant(std::numeric_limits<double>::quiet_NaN())), std::invalid_argument);
}

TEST(UnitQuaternion, NormalisesRounding) {
  EXPECT_NEAR(unitQuaternion(Quat(0.5001, -0.5, 0.4999, -0.5002)).norm(), 1.0, 1e-15);
}

TEST(UnitQuaternion, RefusesOtherNorms) {
  EXPECT_THROW((void)unitQuaternion(Quat(0.0, 0.0, 0.0, 0.0)), std::invalid_argument);
  EXPECT_THROW((void)unitQuaternion(Quat(1.1, 0.0, 0.0, 0.0)), std::invalid_argument);
  EXPECT_THROW((void)unitQuaternion(Quat(std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nanomap
