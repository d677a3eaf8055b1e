#include "drivers/recording/log_index.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>
#include <unordered_map>
#include <utility>

namespace nanomap {
namespace {

/// A plausible header, until it is known where the next one is.
struct Candidate {
  LogEvent event;
  std::uint64_t end_bytes = 0;  ///< offset behind its message
};

/// Turns candidates, by increasing offset, into events and damage.
class IndexBuilder {
 public:
  void add(std::uint64_t offset_bytes, const LogHeader& header, std::string_view channel) {
    settle(offset_bytes, LogDamage::Cause::kOverrun);
    LogEvent event;
    event.log_stamp = header.log_stamp;
    event.offset_bytes = offset_bytes;
    event.channel = channelIndex(channel);
    event.data_bytes = header.data_bytes;
    pending_ = Candidate{event, offset_bytes + kLogHeaderBytes + header.channel_bytes + header.data_bytes};
  }

  /// A sync word too near the end of the file for the rest of its header.
  void addCutHeader(std::uint64_t offset_bytes) {
    if (pending_ && pending_->end_bytes > offset_bytes) return;
    settle(offset_bytes, LogDamage::Cause::kOverrun);
    blame(offset_bytes, LogDamage::Cause::kCutOff);
  }

  [[nodiscard]] LogIndex finish(std::uint64_t size_bytes) && {
    settle(size_bytes, LogDamage::Cause::kCutOff);
    closeGap(size_bytes);
    index_.size_bytes = size_bytes;
    return std::move(index_);
  }

 private:
  /// Nothing plausible lies between the pending candidate's header and `limit_bytes`: an event if it ends by then.
  void settle(std::uint64_t limit_bytes, LogDamage::Cause otherwise) {
    if (!pending_) return;
    if (pending_->end_bytes <= limit_bytes) {
      closeGap(pending_->event.offset_bytes);
      index_.events.push_back(pending_->event);
      covered_bytes_ = pending_->end_bytes;
    } else {
      blame(pending_->event.offset_bytes, otherwise);
    }
    pending_.reset();
  }

  void blame(std::uint64_t offset_bytes, LogDamage::Cause cause) {
    if (offset_bytes == covered_bytes_) gap_cause_ = cause;
  }

  /// What is not covered before `end_bytes` is damage.
  void closeGap(std::uint64_t end_bytes) {
    if (end_bytes > covered_bytes_) {
      index_.damage.push_back({gap_cause_, covered_bytes_, end_bytes - covered_bytes_});
    }
    gap_cause_ = LogDamage::Cause::kGarbage;
  }

  [[nodiscard]] std::uint32_t channelIndex(std::string_view channel) {
    const auto [known, is_new] =
        channel_index_.try_emplace(std::string(channel), static_cast<std::uint32_t>(index_.channels.size()));
    if (is_new) index_.channels.emplace_back(channel);
    return known->second;
  }

  LogIndex index_;
  std::unordered_map<std::string, std::uint32_t> channel_index_;
  std::optional<Candidate> pending_;
  std::uint64_t covered_bytes_ = 0;  ///< offset behind the last event
  LogDamage::Cause gap_cause_ = LogDamage::Cause::kGarbage;
};

/// The candidate whose sync word `bytes` begin with, if it is plausible.
void examine(std::string_view bytes, std::uint64_t offset_bytes, IndexBuilder& builder) {
  if (bytes.size() < kLogHeaderBytes) return builder.addCutHeader(offset_bytes);
  const std::optional<LogHeader> header = parseLogHeader(bytes);
  if (!header) return;
  const std::string_view channel = bytes.substr(kLogHeaderBytes, header->channel_bytes);
  if (channel.size() < header->channel_bytes) return builder.addCutHeader(offset_bytes);
  if (isChannelName(channel)) builder.add(offset_bytes, *header, channel);
}

}  // namespace

std::string_view toString(LogDamage::Cause cause) {
  switch (cause) {
    case LogDamage::Cause::kGarbage:
      return "garbage";
    case LogDamage::Cause::kOverrun:
      return "an event that runs into the next one";
    case LogDamage::Cause::kCutOff:
      return "an event cut off by the end of the file";
  }
  return "?";
}

void LogIndex::append(LogIndex next) {
  std::vector<std::uint32_t> renumbered;
  for (std::string& channel : next.channels) {
    const auto known = std::find(channels.begin(), channels.end(), channel);
    renumbered.push_back(static_cast<std::uint32_t>(known - channels.begin()));
    if (known == channels.end()) channels.push_back(std::move(channel));
  }
  for (LogEvent event : next.events) {
    event.offset_bytes += size_bytes;
    event.channel = renumbered[event.channel];
    events.push_back(event);
  }
  for (LogDamage found : next.damage) {
    found.offset_bytes += size_bytes;
    damage.push_back(found);
  }
  size_bytes += next.size_bytes;
}

LogIndex indexLog(std::istream& log, std::size_t window_bytes) {
  assert(window_bytes >= kMinLogWindowBytes);
  IndexBuilder builder;
  std::string window(window_bytes, '\0');
  std::size_t held = 0;             // bytes of the log in the window
  std::uint64_t window_offset = 0;  // of the window in the log
  for (bool at_end = false; !at_end;) {
    log.read(window.data() + held, static_cast<std::streamsize>(window_bytes - held));
    held += static_cast<std::size_t>(log.gcount());
    at_end = held < window_bytes;

    // A sync word is examined once its whole header is in the window, or the log ends.
    const std::string_view bytes = std::string_view(window).substr(0, held);
    const std::size_t scanned = at_end ? held : held - kMinLogWindowBytes + 1;
    for (std::size_t at = bytes.find(kLogSync); at < scanned; at = bytes.find(kLogSync, at + 1)) {
      examine(bytes.substr(at), window_offset + at, builder);
    }
    window_offset += scanned;
    held -= scanned;
    std::memmove(window.data(), window.data() + scanned, held);
  }
  return std::move(builder).finish(window_offset);
}

}  // namespace nanomap
