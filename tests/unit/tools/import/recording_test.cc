#include "tools/import/recording.h"

#include <gtest/gtest.h>

#include <limits>

namespace nanomap {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

Time at(std::int64_t ms) { return timeFromNanoseconds(ms * 1'000'000); }

/// Images every 30 ms, poses every 10 ms.
Recording recordingOf(std::size_t images) {
  Recording recording;
  for (std::size_t i = 0; i < images; ++i) recording.images.push_back({at(30 * static_cast<std::int64_t>(i)), i, {}});
  for (std::int64_t i = 0; i < 3 * static_cast<std::int64_t>(images); ++i) recording.poses.push_back({at(10 * i), {}});
  return recording;
}

TEST(Select, KeepsAllImagesByDefault) {
  const Recording kept = select(recordingOf(4), 1, kAll);
  EXPECT_EQ(kept.images.size(), 4U);
  EXPECT_EQ(kept.poses.back().stamp, at(90));
}

TEST(Select, TakesEveryNthFromTheFirst) {
  const Recording kept = select(recordingOf(7), 3, kAll);
  ASSERT_EQ(kept.images.size(), 3U);
  EXPECT_EQ(kept.images[1].sequence, 3U);
  EXPECT_EQ(kept.images[2].sequence, 6U);
}

TEST(Select, EndsPosesBehindTheLastImage) {
  Recording recording = recordingOf(7);
  for (RecordedImage& image : recording.images) image.stamp += std::chrono::milliseconds(5);
  const Recording kept = select(recording, 2, 2);
  ASSERT_EQ(kept.images.size(), 2U);
  EXPECT_EQ(kept.images.back().stamp, at(65));
  EXPECT_EQ(kept.poses.back().stamp, at(70));
}

TEST(Select, IsEmptyWithoutImages) {
  EXPECT_TRUE(select(recordingOf(0), 1, kAll).images.empty());
  EXPECT_TRUE(select(recordingOf(3), 1, 0).poses.empty());
}

}  // namespace
}  // namespace nanomap
