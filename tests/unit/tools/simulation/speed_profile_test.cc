#include "tools/simulation/speed_profile.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nanomap::simulation {
namespace {

constexpr double kStep_m = 0.05;
constexpr SpeedLimits kLimits = {.max_acceleration_m_s2 = 7.0, .max_speed_up_m_s2 = 4.0, .max_yaw_rate_rad_s = 1.5};

TEST(SpeedProfile, OnAStraightAcceleratesCruisesAndBrakes) {
  const std::vector<double> speed_m_s =
      speedProfile(kStep_m, std::vector<double>(601, 0.0), std::vector<double>(601, 6.0), kLimits);
  EXPECT_EQ(speed_m_s.front(), 0.0);
  EXPECT_EQ(speed_m_s.back(), 0.0);
  EXPECT_NEAR(speed_m_s[20], std::sqrt(2.0 * 4.0 * 1.0), 1e-9);        // 1 m after the start
  EXPECT_NEAR(speed_m_s[300], 6.0, 1e-12);                             // 15 m: cruising
  EXPECT_NEAR(speed_m_s[600 - 20], std::sqrt(2.0 * 7.0 * 1.0), 1e-9);  // 1 m before the end
}

TEST(SpeedProfile, BrakesInTimeForASlowStretch) {
  std::vector<double> wanted_m_s(601, 6.0);
  std::fill(wanted_m_s.begin() + 300, wanted_m_s.begin() + 310, 1.0);
  const std::vector<double> speed_m_s = speedProfile(kStep_m, std::vector<double>(601, 0.0), wanted_m_s, kLimits);
  EXPECT_NEAR(speed_m_s[305], 1.0, 1e-12);
  for (std::size_t i = 1; i < speed_m_s.size(); ++i) {
    const double along_m_s2 = (speed_m_s[i] * speed_m_s[i] - speed_m_s[i - 1] * speed_m_s[i - 1]) / (2.0 * kStep_m);
    EXPECT_LE(along_m_s2, 4.0 + 1e-9);
    EXPECT_GE(along_m_s2, -7.0 - 1e-9);
  }
}

TEST(SpeedProfile, InABendAccelerationAndYawRateStayInTheirBounds) {
  std::vector<double> curvature_per_m(601, 0.0);
  for (std::size_t i = 280; i < 320; ++i) curvature_per_m[i] = -0.4;
  const std::vector<double> speed_m_s = speedProfile(kStep_m, curvature_per_m, std::vector<double>(601, 10.0), kLimits);
  for (std::size_t i = 280; i < 320; ++i) {
    EXPECT_LE(speed_m_s[i] * 0.4, 1.5 + 1e-9);
    EXPECT_LE(speed_m_s[i] * speed_m_s[i] * 0.4, 7.0 + 1e-9);
  }
  EXPECT_GT(*std::max_element(speed_m_s.begin(), speed_m_s.end()), 6.0);
}

}  // namespace
}  // namespace nanomap::simulation
