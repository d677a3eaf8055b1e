#include "drivers/recording/log_header.h"

#include <algorithm>

#include "drivers/lcm/byte_cursor.h"
#include "drivers/lcm/convert.h"

namespace nanomap {

bool isChannelName(std::string_view name) {
  constexpr char kDelete = 0x7F;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == kDelete; };
  return !name.empty() && name.size() <= kMaxChannelBytes && std::none_of(name.begin(), name.end(), is_control);
}

std::optional<LogHeader> parseLogHeader(std::string_view bytes) {
  if (bytes.size() < kLogHeaderBytes || !bytes.starts_with(kLogSync)) return std::nullopt;
  ByteCursor cursor({reinterpret_cast<const std::uint8_t*>(bytes.data()), kLogHeaderBytes});
  static_cast<void>(cursor.take(kLogSync.size() + sizeof(std::int64_t)));  // sync word, event number
  const Converted<Time> stamp = timeFromUtime(cursor.read<std::int64_t>());
  const auto channel_bytes = cursor.read<std::int32_t>();
  const auto data_bytes = cursor.read<std::int32_t>();
  if (!std::holds_alternative<Time>(stamp) || channel_bytes < 1 || data_bytes < 0) return std::nullopt;
  const LogHeader header{std::get<Time>(stamp), static_cast<std::uint32_t>(channel_bytes),
                         static_cast<std::uint32_t>(data_bytes)};
  return header.channel_bytes <= kMaxChannelBytes ? std::optional(header) : std::nullopt;
}

}  // namespace nanomap
