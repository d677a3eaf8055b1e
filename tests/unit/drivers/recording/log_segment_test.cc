#include "drivers/recording/log_segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SegmentName, FileNamesSortAsFlightsAndParts) {
  EXPECT_EQ(fileName({.flight = 12, .part = 3}), "flight-000012-part-0003.lcmlog");
  EXPECT_LT(fileName({.flight = 9, .part = 10}), fileName({.flight = 10, .part = 2}));
  EXPECT_LT(fileName({.flight = 9, .part = 9}), fileName({.flight = 9, .part = 10}));
}

TEST(SegmentName, EveryFileNameIsReadBack) {
  for (const SegmentName name : {SegmentName{1, 1}, {999'999, 9'999}, {1'000'000, 12'345}, {4'294'967'295, 0}}) {
    EXPECT_EQ(parseSegmentName(fileName(name)), name) << fileName(name);
  }
}

TEST(SegmentName, OtherFilesHaveNone) {
  for (const auto* other :
       {"", "flight.lcmlog", "flight-1-part-.lcmlog", "flight-1-part-2.lcmlog.old", "flight--1-part-2.lcmlog",
        "flight-4294967296-part-1.lcmlog", "my-flight-1-part-1.lcmlog", "flight-1-part-1"}) {
    EXPECT_EQ(parseSegmentName(other), std::nullopt) << other;
  }
}

TEST(ListSegments, AreByFlightAndPartAndNothingElse) {
  const TemporaryFolder folder;
  EXPECT_THAT(listSegments(folder.path()), IsEmpty());
  for (const SegmentName name : {SegmentName{2, 1}, {1, 10'000}, {1, 9'999}}) folder.write(fileName(name), "x");
  folder.write("notes.txt", "x");
  std::filesystem::create_directories(folder.path() / fileName({3, 1}));
  std::vector<SegmentName> names;
  for (const LogSegment& segment : listSegments(folder.path())) {
    EXPECT_TRUE(std::filesystem::exists(segment.path));
    names.push_back(segment.name);
  }
  EXPECT_THAT(names, ElementsAre(SegmentName{1, 9'999}, SegmentName{1, 10'000}, SegmentName{2, 1}));
}

}  // namespace
}  // namespace nanomap
