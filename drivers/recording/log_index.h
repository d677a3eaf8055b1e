#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "drivers/recording/log_header.h"

namespace nanomap {

/// Where one event of an LCM log is. The format, integers big-endian: sync word i32, event number i64, log time [us]
/// i64, channel length i32, data length i32, channel, data.
struct LogEvent {
  Time log_stamp{};                ///< when it was logged; whole microseconds
  std::uint64_t offset_bytes = 0;  ///< of its sync word in the file
  std::uint32_t channel = 0;       ///< index into LogIndex::channels
  std::uint32_t data_bytes = 0;    ///< size of the message
};

/// Bytes of a log that hold no event, and why.
struct LogDamage {
  enum class Cause : std::uint8_t {
    kGarbage,  ///< not the start of an event
    kOverrun,  ///< an event whose length reaches into the next one
    kCutOff,   ///< an event that goes on after the end of the file
  };
  Cause cause = Cause::kGarbage;  ///< of the first byte
  std::uint64_t offset_bytes = 0;
  std::uint64_t size_bytes = 0;
};

[[nodiscard]] std::string_view toString(LogDamage::Cause cause);

/// What a log holds and what of it is lost.
struct LogIndex {
  std::vector<LogEvent> events;       ///< in the order of the file
  std::vector<std::string> channels;  ///< in order of first appearance
  std::vector<LogDamage> damage;      ///< by increasing offset; spans touch only where files do
  std::uint64_t size_bytes = 0;       ///< of the log: events and damage cover it

  /// As if the file of `next` stood behind this one in one file.
  void append(LogIndex next);
};

/// Fewest bytes of a log to be held in memory at a time: a header with the longest channel name.
inline constexpr std::size_t kMinLogWindowBytes = kLogHeaderBytes + kMaxChannelBytes;

/// Indexes a log, in one pass, and survives whatever is wrong with it.
///
/// A plausible header starts a candidate: the sync word, a stamp in range, lengths that are not negative, a channel of
/// 1 to 63 bytes without control characters. A candidate is an event if it ends before the next one starts. No event
/// contains another: one that seems to has a damaged length, and the events it would have swallowed are found.
/// What the bytes of a message mean is for decode() to judge.
///
/// @param window_bytes  of the log held in memory at a time, at least kMinLogWindowBytes
/// Allocates: the window, and 24 bytes an event. Threads: a function of its arguments.
[[nodiscard]] LogIndex indexLog(std::istream& log, std::size_t window_bytes);

}  // namespace nanomap
