#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "drivers/recording/log_error.h"
#include "drivers/recording/log_index.h"

namespace nanomap {

/// Reads LCM logs, damaged ones too: whatever is not a whole event is skipped, counted, and it is said where. Several
/// files are read as the parts of one log, whose offsets count through all of them.
/// Allocates: the index, and a window of fixed size while indexing. Threads: one.
class LogReader {
 public:
  /// Indexes the whole file. An empty file is a log without events.
  /// @throws LogError if the file cannot be read, or is not empty and holds no event
  explicit LogReader(std::filesystem::path path) : LogReader(std::vector{std::move(path)}) {}

  /// @param paths  in the order of the recording, at least one
  /// @throws LogError as above, where one part may hold no event if another does
  explicit LogReader(const std::vector<std::filesystem::path>& paths);

  [[nodiscard]] const LogIndex& index() const { return index_; }

  /// In the order of the file.
  [[nodiscard]] const std::vector<LogEvent>& events() const { return index_.events; }

  /// By log time; events of the same time stay in the order of the file.
  [[nodiscard]] std::vector<LogEvent> mergedByTime() const;

  [[nodiscard]] const std::string& channelOf(const LogEvent& event) const { return index_.channels[event.channel]; }

  /// What was skipped, by increasing offset.
  [[nodiscard]] const std::vector<LogDamage>& damage() const { return index_.damage; }
  [[nodiscard]] std::uint64_t damagedBytes() const;

  /// The encoded message of an event of this log, into `data`, whose capacity is reused.
  /// @throws LogError if the file has changed since it was indexed, or cannot be read
  void read(const LogEvent& event, std::vector<std::uint8_t>& data);

 private:
  struct Part {
    std::filesystem::path path;
    std::ifstream file;
    std::uint64_t begin_bytes = 0;  ///< its offset in the whole
  };

  [[nodiscard]] static Part open(const std::filesystem::path& path);
  void append(Part part);
  [[nodiscard]] Part& partOf(const LogEvent& event);

  std::vector<Part> parts_;
  LogIndex index_;
};

}  // namespace nanomap
