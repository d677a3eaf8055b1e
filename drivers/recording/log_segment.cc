#include "drivers/recording/log_segment.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace nanomap {
namespace {

constexpr std::string_view kFlight = "flight-";
constexpr std::string_view kPart = "-part-";
constexpr std::string_view kExtension = ".lcmlog";

/// Takes `word` off the front of `text`. False if it does not begin so.
bool takeWord(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// Takes a number without sign off the front of `text`. False if it does not begin with one.
bool takeNumber(std::string_view& text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

std::string fileName(const SegmentName& name) {
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, "flight-%06u-part-%04u", name.flight, name.part);
  return numbers + std::string(kExtension);
}

std::optional<SegmentName> parseSegmentName(std::string_view file_name) {
  SegmentName name;
  const bool whole = takeWord(file_name, kFlight) && takeNumber(file_name, name.flight) && takeWord(file_name, kPart) &&
                     takeNumber(file_name, name.part) && file_name == kExtension;
  return whole ? std::optional(name) : std::nullopt;
}

std::vector<LogSegment> listSegments(const std::filesystem::path& folder) {
  std::vector<LogSegment> segments;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = parseSegmentName(entry.path().filename().string());
    if (name && entry.is_regular_file()) segments.push_back({*name, entry.path()});
  }
  std::sort(segments.begin(), segments.end(), [](const LogSegment& a, const LogSegment& b) { return a.name < b.name; });
  return segments;
}

}  // namespace nanomap
