#include "tools/replay/percentile.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

std::vector<Duration> upTo(int count) {
  std::vector<Duration> samples;
  for (int i = count; i >= 1; --i) samples.emplace_back(i);
  return samples;
}

TEST(Percentile, WithoutSamplesIsZero) { EXPECT_EQ(percentile({}, 0.5), Duration(0)); }

TEST(Percentile, OfOneSampleIsThatSample) {
  EXPECT_EQ(percentile({Duration(7)}, 0.01), Duration(7));
  EXPECT_EQ(percentile({Duration(7)}, 1.0), Duration(7));
}

TEST(Percentile, IsTheNearestRank) {
  EXPECT_EQ(percentile(upTo(100), 0.50), Duration(50));
  EXPECT_EQ(percentile(upTo(100), 0.99), Duration(99));
  EXPECT_EQ(percentile(upTo(100), 1.0), Duration(100));
  EXPECT_EQ(percentile(upTo(5), 0.5), Duration(3));
}

}  // namespace
}  // namespace nanomap
