#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/replay/replaying.h"
#include "tools/replay/summary.h"

namespace nanomap::test {
namespace {

using ::testing::HasSubstr;

std::filesystem::path flight() {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.fly(0, 1000);
  return log.close();
}

void overwrite(const std::filesystem::path& path, std::uint64_t offset_bytes, std::size_t size_bytes) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(offset_bytes));
  file << std::string(size_bytes, '\x5A');
  ASSERT_TRUE(file.good());
}

TEST(DamagedLog, EmptyOneHoldsNoEvent) {
  const auto path = testFile("empty");
  std::ofstream{path};
  try {
    (void)replayed(path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds no event"));
  }
}

TEST(DamagedLog, WithoutMessagesOfOursAnswersNothing) {
  LogWriter writer(testFile("foreign"));
  writer.write("SOMETHING", atMs(0), toMessage(FlightLog::flightPose(0), std::nullopt));
  writer.close();
  const ReplayReport report = replayed(testFile("foreign"));
  EXPECT_EQ(report.answered_frames, 0U);
  EXPECT_FALSE(report.has_camera);
}

TEST(DamagedLog, CutInTheMiddleOfAMessageLosesOnlyThat) {
  const auto path = flight();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10);
  const ReplayReport report = replayed(path);
  ASSERT_EQ(report.damage.size(), 1U);
  EXPECT_EQ(report.damage[0].cause, LogDamage::Cause::kCutOff);
  EXPECT_EQ(report.chain.views_inserted, 10U);
  EXPECT_EQ(report.answered_frames, 10U);
}

TEST(DamagedLog, DamageInTheMiddleIsSkippedAndSaidWhere) {
  const auto path = flight();
  const LogEvent hit = LogReader(path).events()[50];
  overwrite(path, hit.offset_bytes, 4);
  const ReplayReport report = replayed(path);
  ASSERT_EQ(report.damage.size(), 1U);
  EXPECT_EQ(report.damage[0].offset_bytes, hit.offset_bytes);
  EXPECT_EQ(report.chain.views_inserted, 11U);
  EXPECT_EQ(report.chain.posesAccepted(), 100U);
  EXPECT_THAT(summaryOf(report, {}), HasSubstr("from offset " + std::to_string(hit.offset_bytes)));
}

TEST(DamagedLog, DamagedMessageIsCounted) {
  const auto path = flight();
  LogReader reader(path);
  for (const LogEvent& event : reader.events()) {
    if (reader.channelOf(event) != "DEPTH") continue;
    overwrite(path, event.offset_bytes + 28 + 5, event.data_bytes);
    break;
  }
  const ReplayReport report = replayed(path);
  EXPECT_TRUE(report.damage.empty());
  EXPECT_EQ(report.chain.views_inserted, 10U);
  expectEveryFrameCounted(report);
}

}  // namespace
}  // namespace nanomap::test
