#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nanomap {

/// `message` as bytes, hash first, into `bytes`, whose capacity is reused. False if it is larger than LCM can tell.
template <class Message>
[[nodiscard]] bool encodeInto(const Message& message, std::vector<std::uint8_t>& bytes) {
  const int size = message.getEncodedSize();
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return message.encode(bytes.data(), 0, size) == size;
}

}  // namespace nanomap
