#pragma once

#include <string>
#include <vector>

#include "drivers/recording/log_reader.h"

namespace nanomap {

/// The messages on a channel of the log that python_log.py wrote; the channel of the filled ones is their type's name.
inline std::vector<std::vector<std::uint8_t>> exampleMessages(const std::string& channel) {
  LogReader log(NANOMAP_EXAMPLE_LOG);
  std::vector<std::vector<std::uint8_t>> messages;
  for (const LogEvent& event : log.events()) {
    if (log.channelOf(event) != channel) continue;
    log.read(event, messages.emplace_back());
  }
  return messages;
}

}  // namespace nanomap
