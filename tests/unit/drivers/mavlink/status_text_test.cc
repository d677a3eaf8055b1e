#include "drivers/mavlink/status_text.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

TEST(StatusText, FitsOneMessage) {
  using Chunks = std::vector<StatusTextChunk>;
  EXPECT_EQ(statusTextChunks(Severity::kWarning, "", 7), (Chunks{{Severity::kWarning, 0, 0, ""}}));
  const std::string fifty(50, 'x');
  EXPECT_EQ(statusTextChunks(Severity::kWarning, fifty, 7), (Chunks{{Severity::kWarning, 0, 0, fifty}}));
}

TEST(StatusText, IsCutIntoChunksOfOneId) {
  const auto chunks = statusTextChunks(Severity::kError, std::string(50, 'a') + "b", 7);
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(chunks[0], (StatusTextChunk{Severity::kError, 7, 0, std::string(50, 'a')}));
  EXPECT_EQ(chunks[1], (StatusTextChunk{Severity::kError, 7, 1, "b"}));
  EXPECT_EQ(statusTextChunks(Severity::kError, std::string(60, 'a'), 0).front().id, 1);
}

TEST(StatusText, OfFullChunksEndsWithAnEmptyOne) {
  const auto chunks = statusTextChunks(Severity::kInfo, std::string(100, 'a'), 7);
  ASSERT_EQ(chunks.size(), 3U);
  EXPECT_EQ(chunks.back().text, "");
}

TEST(StatusText, IsBoundedAndPlain) {
  const auto chunks = statusTextChunks(Severity::kInfo, std::string(10'000, 'a'), 7);
  ASSERT_EQ(chunks.size(), kMaxStatusTextChunks);
  EXPECT_LT(chunks.back().text.size(), 50U);
  EXPECT_EQ(statusTextChunks(Severity::kInfo, "h\xC3\xB6her\n\xFF", 7).front().text, "h??her??");
}

}  // namespace
}  // namespace nanomap
