#pragma once

#include <cstdint>
#include <string>

namespace nanomap {

/// Big-endian, `size` bytes.
inline std::string bigEndian(std::int64_t value, int size) {
  std::string bytes;
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i)));
  return bytes;
}

/// An event as the format's description has it, written without liblcm; lengths may lie.
struct EventBytes {
  std::int64_t number = 0;
  std::int64_t utime_us = 0;
  std::string channel = "CHANNEL";
  std::string data = "data";
  std::int32_t channel_length = static_cast<std::int32_t>(channel.size());
  std::int32_t data_length = static_cast<std::int32_t>(data.size());

  [[nodiscard]] std::string str() const {
    return bigEndian(0xEDA1DA01, 4) + bigEndian(number, 8) + bigEndian(utime_us, 8) + bigEndian(channel_length, 4) +
           bigEndian(data_length, 4) + channel + data;
  }
};

inline std::string event(std::int64_t utime_us, const std::string& channel, const std::string& data) {
  return EventBytes{.utime_us = utime_us, .channel = channel, .data = data}.str();
}

}  // namespace nanomap
