#include "drivers/mavlink/parameter_value.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace nanomap {
namespace {

constexpr std::uint8_t kInt32 = 6;
constexpr std::uint8_t kReal32 = 9;

float bytesOf(std::int32_t value) { return std::bit_cast<float>(value); }

TEST(ParameterValue, RealIsItself) {
  EXPECT_EQ(numberOf({"A", 1.5F, kReal32}, AutopilotKind::kPx4), 1.5);
  EXPECT_EQ(numberOf({"A", 1.5F, kReal32}, AutopilotKind::kArduPilot), 1.5);
}

TEST(ParameterValue, IntegerIsBytesOfPx4AndNumberOfArduPilot) {
  EXPECT_EQ(numberOf({"A", bytesOf(15), kInt32}, AutopilotKind::kPx4), 15.0);
  EXPECT_EQ(numberOf({"A", bytesOf(0), kInt32}, AutopilotKind::kPx4), 0.0);
  EXPECT_EQ(numberOf({"A", bytesOf(-3), kInt32}, AutopilotKind::kPx4), -3.0);
  EXPECT_EQ(numberOf({"A", 6.0F, kInt32}, AutopilotKind::kArduPilot), 6.0);
  constexpr std::uint8_t kInt8 = 2;
  EXPECT_EQ(numberOf({"A", -1.0F, kInt8}, AutopilotKind::kArduPilot), -1.0);
}

TEST(ParameterValue, WhatIsNoNumberIsNone) {
  EXPECT_FALSE(numberOf({"A", std::numeric_limits<float>::quiet_NaN(), kReal32}, AutopilotKind::kPx4));
  EXPECT_FALSE(numberOf({"A", std::numeric_limits<float>::infinity(), kReal32}, AutopilotKind::kArduPilot));
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{0, 7, 8, 10, 255}) {
    EXPECT_FALSE(numberOf({"A", 1.0F, type}, AutopilotKind::kPx4)) << int{type};
  }
}

}  // namespace
}  // namespace nanomap
