#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/time.h"

namespace nanomap {

/// What every event of an LCM log starts with, as bytes of the file.
inline constexpr std::string_view kLogSync = "\xED\xA1\xDA\x01";

inline constexpr std::size_t kLogHeaderBytes = 28;

/// LCM_MAX_CHANNEL_NAME_LENGTH.
inline constexpr std::size_t kMaxChannelBytes = 63;

/// The header of an event, without its event number, which nothing needs.
struct LogHeader {
  Time log_stamp{};
  std::uint32_t channel_bytes = 0;
  std::uint32_t data_bytes = 0;
};

/// Whether an event's channel can have this name: 1 to kMaxChannelBytes bytes without control characters.
[[nodiscard]] bool isChannelName(std::string_view name);

/// The header in the first kLogHeaderBytes of `bytes`; empty if they are too few, or no event can start like this.
[[nodiscard]] std::optional<LogHeader> parseLogHeader(std::string_view bytes);

}  // namespace nanomap
