#include "tools/replay/log_files.h"

#include <stdexcept>

#include "drivers/recording/log_segment.h"

namespace nanomap {

std::vector<std::filesystem::path> logFiles(const std::vector<std::string>& arguments) {
  std::vector<std::filesystem::path> files;
  for (const std::string& argument : arguments) {
    if (!std::filesystem::is_directory(argument)) {
      files.emplace_back(argument);
      continue;
    }
    const std::vector<LogSegment> segments = listSegments(argument);
    if (segments.empty()) {
      throw std::runtime_error(argument + " holds no recording: its parts are named like " + fileName({}));
    }
    for (const LogSegment& segment : segments) {
      if (segment.name.flight == segments.back().name.flight) files.push_back(segment.path);
    }
  }
  return files;
}

}  // namespace nanomap
