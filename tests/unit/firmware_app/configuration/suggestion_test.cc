#include "firmware_app/configuration/suggestion.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

TEST(EditDistance, OfEmptyWordsIsTheOthersLength) {
  EXPECT_EQ(editDistance("", ""), 0U);
  EXPECT_EQ(editDistance("", "abc"), 3U);
  EXPECT_EQ(editDistance("abc", ""), 3U);
}

TEST(EditDistance, CountsOneForEachKindOfSlip) {
  EXPECT_EQ(editDistance("views", "views"), 0U);
  EXPECT_EQ(editDistance("views", "view"), 1U);
  EXPECT_EQ(editDistance("view", "views"), 1U);
  EXPECT_EQ(editDistance("views", "vievs"), 1U);
  EXPECT_EQ(editDistance("views", "veiws"), 1U);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
}

TEST(NearestWord, IsTheOneWithFewestSlips) {
  EXPECT_EQ(nearestWord("history.veiws", {"history.waiting_views", "history.views"}), "history.views");
}

TEST(NearestWord, IsEmptyWhenNothingIsNear) {
  EXPECT_EQ(nearestWord("planner.speed", {"history.views", "query.k"}), "");
  EXPECT_EQ(nearestWord("x", {}), "");
}

}  // namespace
}  // namespace nanomap
