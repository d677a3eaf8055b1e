#include "tools/simulation/smoothing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace nanomap::simulation {
namespace {

TEST(Smooth, KeepsStraightLinesAndBothEnds) {
  std::vector<double> line(50);
  std::iota(line.begin(), line.end(), -7.0);
  const std::vector<double> smoothed = smooth(line, 5);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(smoothed[i], line[i], 1e-12);
}

TEST(Smooth, SpreadsAnImpulseOverThreeWindowsAndKeepsItsSum) {
  constexpr std::size_t kHalf = 4;
  std::vector<double> impulse(101, 0.0);
  impulse[50] = 1.0;
  const std::vector<double> smoothed = smooth(impulse, kHalf);
  EXPECT_NEAR(std::accumulate(smoothed.begin(), smoothed.end(), 0.0), 1.0, 1e-12);
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const bool reached = i + 3 * kHalf >= 50 && i <= 50 + 3 * kHalf;
    EXPECT_EQ(smoothed[i] > 1e-9, reached) << i;
    EXPECT_NEAR(smoothed[i], smoothed[100 - i], 1e-12);
  }
}

TEST(Smooth, KeepsTheBoundOnTheSecondDifference) {
  std::vector<double> brake;
  for (int i = 0; i < 200; ++i)
    brake.push_back(i < 100 ? 0.1 * i : 10.0 + 0.1 * (i - 100) - 5e-4 * (i - 100) * (i - 100));
  const std::vector<double> smoothed = smooth(brake, 10);
  for (std::size_t i = 1; i + 1 < smoothed.size(); ++i) {
    EXPECT_LE(std::abs(smoothed[i + 1] - 2.0 * smoothed[i] + smoothed[i - 1]), 1e-3 + 1e-12) << i;
  }
}

TEST(Smooth, LeavesAloneWhatIsTooShort) {
  EXPECT_THAT(smooth(std::vector<double>{}, 3), testing::IsEmpty());
  EXPECT_THAT(smooth(std::vector<double>{4.0}, 3), testing::ElementsAre(4.0));
  EXPECT_THAT(smooth(std::vector<double>{4.0, 9.0, 1.0}, 0), testing::ElementsAre(4.0, 9.0, 1.0));
}

}  // namespace
}  // namespace nanomap::simulation
