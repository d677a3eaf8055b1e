#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"
#include "drivers/lcm/encode.h"
#include "drivers/recording/log_error.h"

namespace lcm {
class LogFile;
}

namespace nanomap {

/// Writes an LCM log. Every event carries the log time that the caller gives it, never the clock's, so that the same
/// calls write the same bytes. Threads: one.
class LogWriter {
 public:
  /// Replaces the file. @throws LogError if it cannot be created
  explicit LogWriter(std::filesystem::path path);

  /// Closes, if close() was not called, without a word about errors.
  ~LogWriter();

  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// @param log_stamp  cut to whole microseconds, not negative
  /// @throws LogError if LCM forbids the channel's name, the message is larger than LCM can tell, the log is closed, or
  ///         the disk is full. Events are buffered: a full disk may show only in a later call.
  template <class Message>
  void write(const std::string& channel, Time log_stamp, const Message& message) {
    if (!encodeInto(message, encoded_)) refuse(channel, "is too large for LCM");
    writeEncoded(channel, log_stamp, encoded_);
  }

  /// The same for a message that is encoded already.
  void writeEncoded(const std::string& channel, Time log_stamp, Bytes message);

  /// Hands everything so far to the operating system: it outlives this process, however that ends.
  /// @throws LogError if that fails, or the log is closed
  void flush();

  /// Flushes and ends the log. @throws LogError if that fails: the log is not whole
  void close();

 private:
  [[noreturn]] void refuse(const std::string& channel, const std::string& why) const;
  [[noreturn]] void failWriting() const;

  std::filesystem::path path_;
  std::unique_ptr<lcm::LogFile> file_;  ///< null once closed
  std::vector<std::uint8_t> encoded_;   ///< reused from message to message
};

}  // namespace nanomap
