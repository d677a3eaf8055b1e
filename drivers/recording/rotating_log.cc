#include "drivers/recording/rotating_log.h"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "drivers/recording/log_header.h"

namespace nanomap {
namespace {

/// With less room on the disk no segment is begun: a disk that fills up again at once would be tried in vain each time,
/// and the rest of the system needs some of it.
constexpr std::uint64_t kLeastRoom_bytes = std::uint64_t{16} << 20U;

std::string unusable(const std::filesystem::path& folder, const std::string& why) {
  return "The recording folder '" + folder.string() + "' cannot be used (" + why +
         "): check that its disk is there, and that it can be written.";
}

std::uint64_t eventBytes(const std::string& channel, std::size_t message_bytes) {
  return kLogHeaderBytes + channel.size() + message_bytes;
}

/// 0 if there is no such file any more.
std::uint64_t sizeOf(const std::filesystem::path& path) {
  std::error_code gone;
  const std::uintmax_t size = std::filesystem::file_size(path, gone);
  return gone ? 0 : size;
}

}  // namespace

RotatingLog::RotatingLog(std::filesystem::path folder, const RotationLimits& limits, Time now)
    : folder_(std::move(folder)), limits_(limits), flushed_at_(now) {
  if (limits_.segment_bytes == 0 || limits_.total_bytes / 2 < limits_.segment_bytes) {
    throw std::invalid_argument("total_bytes must be at least twice segment_bytes, and neither 0");
  }
  const auto start = [this] {
    std::filesystem::create_directories(folder_);
    if (const auto earlier = listSegments(folder_); !earlier.empty()) next_.flight = earlier.back().name.flight + 1;
    begin();
  };
  if (!attempt(start)) throw LogError(fault_);
}

RotatingLog::~RotatingLog() = default;

bool RotatingLog::write(const std::string& channel, Time log_stamp, Bytes message, Retention retention) {
  const std::uint64_t bytes = eventBytes(channel, message.size());
  const bool can_be = isChannelName(channel) && headBytes(channel) + bytes <= limits_.segment_bytes;
  const bool written = can_be && segment_ && attempt([&] {
                         if (segment_bytes_ + bytes > limits_.segment_bytes) {
                           flush();
                           segment_->close();
                           begin();
                         }
                         if (segment_bytes_ == 0) writeHead(log_stamp, channel);
                         append(channel, log_stamp, message);
                       });
  if (written) {
    ++unflushed_events_;
  } else {
    ++counters_.events_lost;
  }
  if (can_be && retention == Retention::kHolds) hold(channel, message);
  return written;
}

void RotatingLog::keepUp(Time now) {
  if (closed_ || now - flushed_at_ < kFlushPeriod) return;
  flushed_at_ = now;
  attempt([this] {
    if (!segment_) begin();
    flush();
  });
}

void RotatingLog::close() {
  closed_ = true;
  if (!segment_) return;
  attempt([this] {
    flush();
    segment_->close();
  });
  segment_.reset();
}

template <class Action>
bool RotatingLog::attempt(Action&& action) {
  try {
    action();
    return true;
  } catch (const std::filesystem::filesystem_error& error) {
    giveUp(unusable(folder_, error.code().message()));
  } catch (const LogError& error) {
    giveUp(error.what());
  }
  return false;
}

void RotatingLog::begin() {
  std::filesystem::create_directories(folder_);
  deleteOldest();
  if (std::filesystem::space(folder_).available < kLeastRoom_bytes) {
    throw LogError(unusable(folder_, "the disk is full"));
  }
  path_ = folder_ / fileName(next_);
  segment_.emplace(path_);
  segment_bytes_ = 0;
  holds_events_ = false;
  ++next_.part;
  ++counters_.segments_begun;
}

void RotatingLog::deleteOldest() {
  const std::vector<LogSegment> segments = listSegments(folder_);
  std::uint64_t total_bytes = limits_.segment_bytes;
  for (const LogSegment& segment : segments) total_bytes += sizeOf(segment.path);
  for (auto oldest = segments.begin(); oldest != segments.end() && total_bytes > limits_.total_bytes; ++oldest) {
    total_bytes -= sizeOf(oldest->path);
    std::filesystem::remove(oldest->path);
    ++counters_.segments_deleted;
  }
}

void RotatingLog::append(const std::string& channel, Time log_stamp, Bytes message) {
  segment_->writeEncoded(channel, log_stamp, message);
  segment_bytes_ += eventBytes(channel, message.size());
}

void RotatingLog::flush() {
  segment_->flush();
  if (!std::filesystem::exists(path_))
    throw LogError("The log '" + path_.string() + "' was deleted while it was written: a new one is begun.");
  if (unflushed_events_ == 0) return;
  counters_.events_written += std::exchange(unflushed_events_, 0);
  holds_events_ = true;
  fault_.clear();
}

void RotatingLog::giveUp(const std::string& fault) {
  fault_ = fault;
  counters_.events_lost += std::exchange(unflushed_events_, 0);
  segment_.reset();
  std::error_code gone;
  if (!holds_events_) std::filesystem::remove(path_, gone);
}

void RotatingLog::hold(const std::string& channel, Bytes message) {
  for (Held& held : held_) {
    if (held.channel == channel) return held.message.assign(message.begin(), message.end());
  }
  held_.push_back({channel, {message.begin(), message.end()}});
}

std::uint64_t RotatingLog::headBytes(const std::string& channel) const {
  std::uint64_t bytes = 0;
  for (const Held& held : held_) {
    if (held.channel != channel) bytes += eventBytes(held.channel, held.message.size());
  }
  return bytes;
}

void RotatingLog::writeHead(Time log_stamp, const std::string& channel) {
  for (const Held& held : held_) {
    if (held.channel != channel) append(held.channel, log_stamp, held.message);
  }
}

}  // namespace nanomap
