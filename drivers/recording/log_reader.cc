#include "drivers/recording/log_reader.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace nanomap {
namespace {

/// Large enough that the disk, not the number of reads, sets the pace.
constexpr std::size_t kWindowBytes = std::size_t{1} << 20;

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace

LogReader::LogReader(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path_, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw LogError("There is no log " + quoted(path_) + ": check the path.");
  }
  if (status.type() != std::filesystem::file_type::regular) {
    throw LogError(quoted(path_) + " is not a regular file: give an LCM log.");
  }
  file_.open(path_, std::ios::binary);
  if (!file_) throw LogError("The log " + quoted(path_) + " cannot be opened: check its permissions.");
  index_ = indexLog(file_, kWindowBytes);
  if (file_.bad()) throw LogError("The log " + quoted(path_) + " cannot be read to its end: check the disk.");
  if (index_.events.empty() && index_.size_bytes > 0) {
    throw LogError(quoted(path_) + " is not an LCM log: " + std::to_string(index_.size_bytes) +
                   " bytes without one whole event. Give a file that lcm-logger or nanomap wrote.");
  }
}

std::vector<LogEvent> LogReader::mergedByTime() const {
  std::vector<LogEvent> merged = index_.events;
  std::stable_sort(merged.begin(), merged.end(),
                   [](const LogEvent& a, const LogEvent& b) { return a.log_stamp < b.log_stamp; });
  return merged;
}

std::uint64_t LogReader::damagedBytes() const {
  return std::accumulate(index_.damage.begin(), index_.damage.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const LogDamage& damage) { return sum + damage.size_bytes; });
}

void LogReader::read(const LogEvent& event, std::vector<std::uint8_t>& data) {
  std::array<char, kLogHeaderBytes> header_bytes{};
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(event.offset_bytes));
  file_.read(header_bytes.data(), header_bytes.size());
  const auto header = file_ ? parseLogHeader({header_bytes.data(), header_bytes.size()}) : std::nullopt;
  if (header && header->data_bytes == event.data_bytes) {
    data.resize(event.data_bytes);
    file_.seekg(static_cast<std::streamoff>(header->channel_bytes), std::ios::cur);
    file_.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
    if (file_) return;
  }
  throw LogError("The log " + quoted(path_) + " changed while it was read: event at byte " +
                 std::to_string(event.offset_bytes) + " is gone. Read a finished log, or a copy.");
}

}  // namespace nanomap
