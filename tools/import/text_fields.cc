#include "tools/import/text_fields.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace nanomap {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr std::int64_t kMaxStamp_s = (std::int64_t{1} << 62) / kNsPerSecond - 1;

bool allDigits(std::string_view text) { return text.find_first_not_of("0123456789") == std::string_view::npos; }

}  // namespace

double parseNumber(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) throw std::invalid_argument(fmt::format("'{}' is not a number", text));
  if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("'{}' is not finite", text));
  return value;
}

Time parseStamp(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  const std::string_view fraction = point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  std::int64_t seconds = 0;
  const auto [stop, error] = std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
  if (whole.empty() || !allDigits(whole) || !allDigits(fraction) || error != std::errc() || seconds > kMaxStamp_s) {
    throw std::invalid_argument(fmt::format("'{}' is not a stamp: write seconds as 1305031102.160407", text));
  }
  std::int64_t ns = 0;
  std::int64_t digit_ns = kNsPerSecond;
  for (const char digit : fraction) {
    digit_ns /= 10;
    ns += (digit - '0') * digit_ns;
  }
  return timeFromNanoseconds(seconds * kNsPerSecond + ns);
}

std::vector<std::string_view> splitFields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

void forEachRecord(const std::filesystem::path& file,
                   const std::function<void(std::span<const std::string_view> fields)>& visit) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::vector<std::string_view> fields = splitFields(line);
    if (fields.empty() || fields.front().front() == '#') continue;
    try {
      visit(fields);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), number, error.what()));
    }
  }
}

}  // namespace nanomap
