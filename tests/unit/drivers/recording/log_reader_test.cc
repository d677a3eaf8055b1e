#include "drivers/recording/log_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/drivers/recording/log_bytes.h"
#include "tests/unit/drivers/temporary_file.h"

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

std::string textOf(LogReader& log, const LogEvent& event) {
  std::vector<std::uint8_t> data;
  log.read(event, data);
  return {data.begin(), data.end()};
}

TEST(LogReader, MissingFileIsNamed) {
  EXPECT_THAT([] { LogReader("no/such.lcmlog"); },
              ThrowsMessage<LogError>(AllOf(HasSubstr("no/such.lcmlog"), HasSubstr("no log"))));
}

TEST(LogReader, DirectoryIsNoLog) {
  EXPECT_THAT([] { LogReader("/tmp"); }, ThrowsMessage<LogError>(HasSubstr("not a regular file")));
}

TEST(LogReader, FileWithoutAnyEventIsNoLog) {
  const TemporaryFile file;
  file.write("this is a text");
  EXPECT_THAT([&] { LogReader(file.path()); }, ThrowsMessage<LogError>(HasSubstr("not an LCM log")));
}

TEST(LogReader, EmptyFileIsAnEmptyLog) {
  const TemporaryFile file;
  file.write("");
  const LogReader log(file.path());
  EXPECT_THAT(log.events(), IsEmpty());
  EXPECT_THAT(log.damage(), IsEmpty());
  EXPECT_THAT(log.mergedByTime(), IsEmpty());
}

TEST(LogReader, EventsAreReadInAnyOrder) {
  const TemporaryFile file;
  file.write(event(1, "A", "one") + "damage" + event(2, "B", "") + event(3, "A", "three"));
  LogReader log(file.path());
  ASSERT_EQ(log.events().size(), 3U);
  EXPECT_EQ(textOf(log, log.events()[2]), "three");
  EXPECT_EQ(textOf(log, log.events()[0]), "one");
  EXPECT_EQ(textOf(log, log.events()[1]), "");
  EXPECT_EQ(log.channelOf(log.events()[1]), "B");
  EXPECT_EQ(log.damagedBytes(), 6U);
}

TEST(LogReader, MergedByTimeIsStable) {
  const TemporaryFile file;
  file.write(event(30, "A", "late") + event(10, "A", "first") + event(10, "B", "second") + event(0, "B", "earliest"));
  LogReader log(file.path());
  std::vector<std::string> order;
  for (const LogEvent& event : log.mergedByTime()) order.push_back(textOf(log, event));
  EXPECT_THAT(order, ElementsAre("earliest", "first", "second", "late"));
}

TEST(LogReader, PartsAreOneLog) {
  const TemporaryFile first, empty, second, cut;
  first.write(event(30, "A", "one") + "damage");
  empty.write("");
  second.write("garbage" + event(20, "B", "two") + event(10, "A", "three"));
  cut.write("cut");
  LogReader log(std::vector{first.path(), empty.path(), second.path(), cut.path()});
  ASSERT_EQ(log.events().size(), 3U);
  EXPECT_EQ(textOf(log, log.events()[1]), "two");
  EXPECT_EQ(textOf(log, log.events()[0]), "one");
  EXPECT_EQ(textOf(log, log.events()[2]), "three");
  EXPECT_EQ(log.channelOf(log.events()[1]), "B");
  EXPECT_EQ(log.channelOf(log.events()[2]), "A");
  EXPECT_THAT(log.index().channels, ElementsAre("A", "B"));
  EXPECT_EQ(textOf(log, log.mergedByTime().front()), "three");
  ASSERT_EQ(log.damage().size(), 3U);
  EXPECT_EQ(log.damage()[1].offset_bytes, log.damage()[0].offset_bytes + 6);
  EXPECT_EQ(log.damagedBytes(), 6U + 7U + 3U);
}

TEST(LogReader, PartThatIsMissingIsNamed) {
  const TemporaryFile first, second;
  first.write(event(30, "A", "one"));
  EXPECT_THAT(
      [&] {
        LogReader(std::vector{first.path(), second.path()});
      },
      ThrowsMessage<LogError>(HasSubstr(second.path().string())));
}

TEST(LogReader, FileThatShrankIsNamed) {
  const TemporaryFile file;
  const std::string first = event(1, "A", "one");
  file.write(first + event(2, "A", "two"));
  LogReader log(file.path());
  std::filesystem::resize_file(file.path(), first.size() + 30);
  std::vector<std::uint8_t> data;
  EXPECT_THAT([&] { log.read(log.events()[1], data); }, ThrowsMessage<LogError>(HasSubstr("changed")));
  EXPECT_EQ(textOf(log, log.events()[0]), "one") << "what is still there is still read";
}

}  // namespace
}  // namespace nanomap
