#include "core/search_radius.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace nanomap {
namespace {

constexpr float kMost = std::numeric_limits<float>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expectGreatest(float radius_m) {
  const auto square = greatestSquareWithin(radius_m);
  ASSERT_TRUE(square) << radius_m;
  EXPECT_LE(std::sqrt(*square), radius_m) << radius_m;
  if (*square < kMost) {
    EXPECT_GT(std::sqrt(std::nextafter(*square, kInfinity)), radius_m) << radius_m;
  }
}

TEST(GreatestSquareWithin, IsTheLastOneWhoseRootIsWithin) {
  for (const float radius_m : {0.0F, 1e-45F, 1e-38F, 1e-30F, 3e-23F, 1e-22F, 1e-19F, 0.1F, 0.5F, 1.0F, 1.7F, 3.0F, 1e9F,
                               1.8e19F, 1.8446742e19F, 1.8446743e19F, 1e30F, kMost, kInfinity}) {
    expectGreatest(radius_m);
  }
  std::mt19937 random(7);
  for (int i = 0; i < 300'000; ++i) {
    const auto radius_m = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0x7FFFFFFFU);
    if (!std::isnan(radius_m)) expectGreatest(radius_m);
  }
  // Every binade's ends, and what lies around them.
  for (int exponent = -149; exponent < 128; ++exponent) {
    const float radius_m = std::ldexp(1.0F, exponent);
    expectGreatest(radius_m);
    expectGreatest(std::nextafter(radius_m, 0.0F));
    expectGreatest(std::nextafter(radius_m, kInfinity));
  }
}

TEST(GreatestSquareWithin, IsNoneForNoRadius) {
  for (const float radius_m : {-1.0F, -1e-45F, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_FALSE(greatestSquareWithin(radius_m));
  }
  EXPECT_EQ(greatestSquareWithin(-0.0F), 0.0F);
}

}  // namespace
}  // namespace nanomap
