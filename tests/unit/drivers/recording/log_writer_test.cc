#include "drivers/recording/log_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bot_core/utime_t.hpp"
#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "tests/unit/drivers/recording/log_bytes.h"
#include "tests/unit/drivers/temporary_file.h"

namespace nanomap {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Time kStamp = timeFromNanoseconds(1'999'999'999);

bot_core::utime_t message(std::int64_t utime_us) {
  bot_core::utime_t value{};
  value.utime = utime_us;
  return value;
}

std::string bytesOf(int messages) {
  const TemporaryFile file;
  LogWriter log(file.path());
  for (int i = 0; i < messages; ++i) log.write("TICK", kStamp + std::chrono::seconds(i), message(i));
  log.close();
  return file.read();
}

TEST(LogWriter, BytesAreThoseOfTheFormat) {
  const std::string data = bigEndian(bot_core::utime_t::getHash(), 8) + bigEndian(0, 8);
  EXPECT_EQ(bytesOf(1), event(1'999'999, "TICK", data)) << "the stamp is cut to microseconds";
}

TEST(LogWriter, SameCallsWriteSameBytes) { EXPECT_EQ(bytesOf(100), bytesOf(100)); }

TEST(LogWriter, NoMessageMakesAnEmptyLog) { EXPECT_EQ(bytesOf(0), ""); }

TEST(LogWriter, WhatIsWrittenIsRead) {
  const TemporaryFile file;
  {
    LogWriter log(file.path());
    log.write("TICK", kStamp, message(42));
  }
  LogReader log(file.path());
  ASSERT_EQ(log.events().size(), 1U);
  EXPECT_EQ(log.events()[0].log_stamp, timeFromNanoseconds(1'999'999'000));
  std::vector<std::uint8_t> data;
  log.read(log.events()[0], data);
  EXPECT_EQ(std::get<bot_core::utime_t>(decode<bot_core::utime_t>(data)).utime, 42);
}

TEST(LogWriter, FileIsReplaced) {
  const TemporaryFile file;
  file.write(std::string(1000, 'x'));
  LogWriter log(file.path());
  log.close();
  EXPECT_EQ(file.read(), "");
}

TEST(LogWriter, FolderThatDoesNotExistIsNamed) {
  EXPECT_THAT([] { LogWriter("/no/such/folder/x.lcmlog"); },
              ThrowsMessage<LogError>(AllOf(HasSubstr("/no/such/folder/x.lcmlog"), HasSubstr("folder"))));
}

TEST(LogWriter, ChannelNamesThatNoReaderTakesAreRefused) {
  const TemporaryFile file;
  LogWriter log(file.path());
  for (const std::string& name : {std::string(), std::string(64, 'x'), std::string("bell\a")}) {
    EXPECT_THAT([&] { log.write(name, kStamp, message(0)); }, ThrowsMessage<LogError>(HasSubstr("channel name")));
  }
  log.write(std::string(63, 'x'), kStamp, message(0));
  log.close();
  EXPECT_EQ(LogReader(file.path()).events().size(), 1U);
}

TEST(LogWriter, WritingAfterCloseIsRefusedAndClosingTwiceIsNot) {
  const TemporaryFile file;
  LogWriter log(file.path());
  log.close();
  log.close();
  EXPECT_THAT([&] { log.write("TICK", kStamp, message(0)); }, ThrowsMessage<LogError>(HasSubstr("closed")));
}

TEST(LogWriter, FullDiskIsReportedAtTheLatestWhenClosing) {
  LogWriter small("/dev/full");
  small.write("TICK", kStamp, message(0));
  EXPECT_THAT([&] { small.close(); }, ThrowsMessage<LogError>(HasSubstr("disk full")));
}

TEST(LogWriter, FullDiskIsReportedWhenTheBufferOverflows) {
  LogWriter large("/dev/full");
  const std::vector<std::uint8_t> message_bytes(1'000'000);
  EXPECT_THAT([&] { large.writeEncoded("BIG", kStamp, message_bytes); },
              ThrowsMessage<LogError>(HasSubstr("disk full")));
}

}  // namespace
}  // namespace nanomap
