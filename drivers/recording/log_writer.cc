#include "drivers/recording/log_writer.h"

#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <utility>

#include "drivers/lcm/convert.h"
#include "drivers/recording/log_header.h"

namespace nanomap {

LogWriter::LogWriter(std::filesystem::path path)
    : path_(std::move(path)), file_(std::make_unique<lcm::LogFile>(path_.string(), "w")) {
  if (!file_->good()) {
    throw LogError("The log '" + path_.string() + "' cannot be created: check that its folder exists and is writable.");
  }
}

LogWriter::~LogWriter() = default;

void LogWriter::writeEncoded(const std::string& channel, Time log_stamp, Bytes message) {
  if (!file_) refuse(channel, "comes after the log was closed");
  if (!isChannelName(channel)) {
    refuse(channel, "has a channel name that is not 1 to " + std::to_string(kMaxChannelBytes) +
                        " bytes without control characters");
  }
  if (message.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    refuse(channel, "is too large for LCM");
  }
  lcm::LogEvent event{};
  event.timestamp = utimeFromTime(log_stamp);
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(message.size());
  event.data = const_cast<std::uint8_t*>(message.data());  // liblcm's event serves reading and writing
  if (file_->writeEvent(&event) != 0) failWriting();
}

void LogWriter::flush() {
  if (!file_ || std::fflush(file_->getFilePtr()) != 0) failWriting();
}

void LogWriter::close() {
  if (!file_) return;
  const bool flushed = std::fflush(file_->getFilePtr()) == 0;
  file_.reset();
  if (!flushed) failWriting();
}

void LogWriter::refuse(const std::string& channel, const std::string& why) const {
  throw LogError("A message for channel '" + channel + "' cannot go into the log '" + path_.string() + "': it " + why +
                 ".");
}

void LogWriter::failWriting() const {
  throw LogError("The log '" + path_.string() + "' cannot be written: is the disk full?");
}

}  // namespace nanomap
