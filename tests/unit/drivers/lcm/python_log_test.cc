#include <gtest/gtest.h>

#include <cstdlib>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/lcm/message_types.h"
#include "drivers/recording/log_reader.h"
#include "drivers/recording/log_writer.h"
#include "tests/unit/drivers/temporary_file.h"

namespace nanomap {
namespace {

/// Decodes and encodes again if it is a message of that type.
template <class Message>
bool rewriteAs(const std::string& channel, Time log_stamp, Bytes bytes, LogWriter& log) {
  if (channel != Message::getTypeName()) return false;
  const Decoded<Message> decoded = decode<Message>(bytes);
  EXPECT_TRUE(std::holds_alternative<Message>(decoded)) << channel;
  if (const auto* message = std::get_if<Message>(&decoded)) log.write(channel, log_stamp, *message);
  return true;
}

TEST(PythonLog, EveryFieldSurvivesTheWayThroughDecoderReaderAndWriter) {
  LogReader example(NANOMAP_EXAMPLE_LOG);
  EXPECT_TRUE(example.damage().empty());
  const TemporaryFile rewritten;
  LogWriter log(rewritten.path());
  std::vector<std::uint8_t> bytes;
  for (const LogEvent& event : example.events()) {
    example.read(event, bytes);
    const std::string& channel = example.channelOf(event);
#define NANOMAP_OR_REWRITE(Message) || rewriteAs<Message>(channel, event.log_stamp, bytes, log)
    static_cast<void>(false NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_OR_REWRITE));
#undef NANOMAP_OR_REWRITE
  }

  DepthImage depth;
  depth.stamp = Time(std::chrono::seconds(4));
  depth.sequence = 9;
  depth.width_px = 4;
  depth.height_px = 3;
  for (int i = 0; i < 12; ++i) depth.pixels.push_back(static_cast<std::uint16_t>(i * 5461));
  log.write("MADE_BY_CPP", depth.stamp, toMessage(depth, "rear", DepthCompression::kBlosc));
  log.close();

  const std::string check = NANOMAP_CHECK_LOG " '" NANOMAP_EXAMPLE_LOG "' '" + rewritten.path().string() + "'";
  EXPECT_EQ(std::system(check.c_str()), 0) << check;
}

}  // namespace
}  // namespace nanomap
