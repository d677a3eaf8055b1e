#include "firmware_app/health/latency_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace nanomap {
namespace {

constexpr double kResolution = 0.021;

TEST(LatencyHistogram, EmptyOneIsZero) {
  const LatencyHistogram latencies;
  EXPECT_EQ(latencies.count(), 0U);
  EXPECT_EQ(latencies.quantile(0.5), Duration::zero());
  EXPECT_EQ(latencies.max(), Duration::zero());
}

TEST(LatencyHistogram, OneIsEveryQuantile) {
  LatencyHistogram latencies;
  latencies.record(std::chrono::microseconds(700));
  for (double share : {0.0, 0.5, 0.99, 1.0}) EXPECT_EQ(latencies.quantile(share), std::chrono::microseconds(700));
}

TEST(LatencyHistogram, QuantilesAreThoseOfTheSortedTimes) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> ms(0.0, 1.5);
  LatencyHistogram latencies;
  std::vector<double> sorted;
  for (int i = 0; i < 10'000; ++i) {
    sorted.push_back(ms(random) * 1e-3);
    latencies.record(fromSeconds(sorted.back()));
  }
  std::sort(sorted.begin(), sorted.end());
  for (double share : {0.01, 0.5, 0.9, 0.99}) {
    const double exact = sorted[static_cast<std::size_t>(share * 10'000.0) - 1];
    EXPECT_NEAR(toSeconds(latencies.quantile(share)) / exact, 1.0, kResolution) << share;
  }
  EXPECT_EQ(latencies.max(), fromSeconds(sorted.back()));
}

TEST(LatencyHistogram, ExtremesCountAtTheEnds) {
  LatencyHistogram latencies;
  latencies.record(Duration(-5));
  latencies.record(std::chrono::hours(1));
  EXPECT_EQ(latencies.count(), 2U);
  EXPECT_LE(latencies.quantile(0.5), std::chrono::microseconds(2));
  EXPECT_EQ(latencies.max(), std::chrono::hours(1));
}

}  // namespace
}  // namespace nanomap
