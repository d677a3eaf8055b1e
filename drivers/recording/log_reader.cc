#include "drivers/recording/log_reader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace nanomap {
namespace {

/// Large enough that the disk, not the number of reads, sets the pace.
constexpr std::size_t kWindowBytes = std::size_t{1} << 20;

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace

LogReader::LogReader(const std::vector<std::filesystem::path>& paths) {
  for (const std::filesystem::path& path : paths) append(open(path));
  if (index_.events.empty() && index_.size_bytes > 0) {
    throw LogError(quoted(paths.front()) + " is not an LCM log: " + std::to_string(index_.size_bytes) +
                   " bytes without one whole event. Give a file that lcm-logger or nanomap wrote.");
  }
}

LogReader::Part LogReader::open(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw LogError("There is no log " + quoted(path) + ": check the path.");
  }
  if (status.type() != std::filesystem::file_type::regular) {
    throw LogError(quoted(path) + " is not a regular file: give an LCM log.");
  }
  Part part{path, std::ifstream(path, std::ios::binary), 0};
  if (!part.file) throw LogError("The log " + quoted(path) + " cannot be opened: check its permissions.");
  return part;
}

void LogReader::append(Part part) {
  LogIndex index = indexLog(part.file, kWindowBytes);
  if (part.file.bad()) throw LogError("The log " + quoted(part.path) + " cannot be read to its end: check the disk.");
  part.begin_bytes = index_.size_bytes;
  parts_.push_back(std::move(part));
  index_.append(std::move(index));
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

LogReader::Part& LogReader::partOf(const LogEvent& event) {
  const auto behind =
      std::upper_bound(parts_.begin(), parts_.end(), event.offset_bytes,
                       [](std::uint64_t offset, const Part& part) { return offset < part.begin_bytes; });
  return *std::prev(behind);
}

void LogReader::read(const LogEvent& event, std::vector<std::uint8_t>& data) {
  Part& part = partOf(event);
  const std::uint64_t offset_bytes = event.offset_bytes - part.begin_bytes;
  std::array<char, kLogHeaderBytes> header_bytes{};
  part.file.clear();
  part.file.seekg(static_cast<std::streamoff>(offset_bytes));
  part.file.read(header_bytes.data(), header_bytes.size());
  const auto header = part.file ? parseLogHeader({header_bytes.data(), header_bytes.size()}) : std::nullopt;
  if (header && header->data_bytes == event.data_bytes) {
    data.resize(event.data_bytes);
    part.file.seekg(static_cast<std::streamoff>(header->channel_bytes), std::ios::cur);
    part.file.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
    if (part.file) return;
  }
  throw LogError("The log " + quoted(part.path) + " changed while it was read: event at byte " +
                 std::to_string(offset_bytes) + " is gone. Read a finished log, or a copy.");
}

}  // namespace nanomap
