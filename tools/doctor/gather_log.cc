#include "tools/doctor/gather_log.h"

#include <utility>
#include <vector>

#include "tools/doctor/listener.h"

namespace nanomap::doctor {

Heard hearLog(LogReader& log, const LcmParameters& lcm) {
  const std::vector<LogEvent> events = log.mergedByTime();
  const Time start = events.empty() ? Time() : events.front().log_stamp;
  Listener listener(lcm, start, events.empty() ? Duration() : events.back().log_stamp - start);
  std::vector<std::uint8_t> bytes;
  for (const LogEvent& event : events) {
    log.read(event, bytes);
    listener.take({.channel = log.channelOf(event), .bytes = bytes, .log_stamp = event.log_stamp}, event.log_stamp);
  }
  Heard heard = std::move(listener).finish();
  heard.from_log = true;
  return heard;
}

}  // namespace nanomap::doctor
