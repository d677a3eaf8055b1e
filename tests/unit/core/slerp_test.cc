#include "core/slerp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nanomap {
namespace {

using Quaternion = Eigen::Quaternion<long double>;

Quaternion unitQuaternion(std::mt19937& random) {
  std::normal_distribution<long double> normal;
  return Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
}

Quaternion turn(long double angle_rad, std::mt19937& random) {
  return Quaternion(Eigen::AngleAxis<long double>(angle_rad, unitQuaternion(random).vec().normalized()));
}

/// The textbook's formula, in a precision in which nothing needs care. @pre the angle is not zero
Eigen::Vector4d plainSlerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double weight) {
  const Eigen::Vector<long double, 4> a = from.coeffs().cast<long double>();
  const Eigen::Vector<long double, 4> b = to.coeffs().cast<long double>();
  const long double sign = a.dot(b) < 0 ? -1 : 1;
  const long double angle = 2 * std::atan2((a - sign * b).norm(), (a + sign * b).norm());
  const auto w = static_cast<long double>(weight);
  return ((std::sin((1 - w) * angle) * a + std::sin(w * angle) * sign * b) / std::sin(angle)).cast<double>();
}

TEST(Slerp, IsTheTextbooksToTheLastBits) {
  constexpr double kRoundings = 1e-15;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0.0, 1.0);
  for (const long double angle_rad : {1e-7L, 1e-3L, 0.05L, 0.12L, 0.1249L, 0.1251L, 0.13L, 0.4L, 1.0L, 3.0L}) {
    for (int i = 0; i < 500; ++i) {
      const Quaternion from = unitQuaternion(random);
      const Quaternion to = from * turn(angle_rad, random);
      const Eigen::Quaterniond a = from.cast<double>();
      const Eigen::Quaterniond b((i % 2 == 0 ? to : Quaternion(-to.coeffs())).cast<double>());
      const double w = weight(random);
      const Eigen::Quaterniond got = slerp(a, b, w);
      EXPECT_LT((got.coeffs() - plainSlerp(a, b, w)).norm(), kRoundings) << angle_rad << ' ' << w;
      EXPECT_NEAR(got.norm(), 1.0, kRoundings);
    }
  }
}

TEST(Slerp, StartsAndEndsAtItsEnds) {
  std::mt19937 random(6);
  for (const long double angle_rad : {0.0L, 1e-9L, 0.01L, 2.0L}) {
    const Quaternion from = unitQuaternion(random);
    const Eigen::Quaterniond a = from.cast<double>();
    const Eigen::Quaterniond b = (from * turn(angle_rad, random)).cast<double>();
    EXPECT_LT((slerp(a, b, 0.0).coeffs() - a.coeffs()).norm(), 1e-15);
    EXPECT_LT((slerp(a, b, 1.0).coeffs() - b.coeffs()).norm(), 1e-15);
    EXPECT_LT((slerp(a, a, 0.5).coeffs() - a.coeffs()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace nanomap
