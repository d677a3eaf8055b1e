#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nanomap {

/// Which part of which flight's recording a file holds. Flights are numbered, not dated: a companion computer without a
/// battery for its clock wakes up in the past.
struct SegmentName {
  std::uint32_t flight = 1;
  std::uint32_t part = 1;

  auto operator<=>(const SegmentName&) const = default;
};

/// "flight-000012-part-0003.lcmlog": names sort as flights and parts do.
[[nodiscard]] std::string fileName(const SegmentName& name);

/// Empty if the file is called otherwise.
[[nodiscard]] std::optional<SegmentName> parseSegmentName(std::string_view file_name);

struct LogSegment {
  SegmentName name;
  std::filesystem::path path;
};

/// The recordings in a folder, the oldest first. Other files are not looked at.
/// @throws std::filesystem::filesystem_error if the folder cannot be read
[[nodiscard]] std::vector<LogSegment> listSegments(const std::filesystem::path& folder);

}  // namespace nanomap
