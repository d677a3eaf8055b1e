#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace nanomap {

/// A finite decimal number. @throws std::invalid_argument quoting `text`
[[nodiscard]] double parseNumber(std::string_view text);

/// Seconds in plain decimal notation ("1305031102.160407") as integer nanoseconds: never through a double, which has
/// 0.2 us to spare at today's dates. Digits below a nanosecond are cut.
/// @throws std::invalid_argument quoting `text`: a sign, an exponent, no digits, or more than 2^62 ns
[[nodiscard]] Time parseStamp(std::string_view text);

/// The fields of one line, parted by blanks.
[[nodiscard]] std::vector<std::string_view> splitFields(std::string_view line);

/// Calls `visit` with the fields of each line that is neither blank nor a `#` comment.
/// @throws std::runtime_error naming the file, and the line for whatever std::invalid_argument `visit` throws
void forEachRecord(const std::filesystem::path& file,
                   const std::function<void(std::span<const std::string_view> fields)>& visit);

}  // namespace nanomap
