#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "drivers/lcm/byte_cursor.h"

namespace nanomap {

/// Why bytes are not a message of the wanted type.
enum class DecodeFault : std::uint8_t {
  kWrongType,      ///< the type's hash is another one
  kTruncated,      ///< the message ends before what its lengths announce
  kBadLength,      ///< a negative length, a string whose first NUL is not its last byte, or more bytes than can be
  kTrailingBytes,  ///< the message goes on after its last field
};
inline constexpr std::size_t kDecodeFaultCount = 4;

[[nodiscard]] std::string_view toString(DecodeFault fault);

template <class Message>
using Decoded = std::variant<Message, DecodeFault>;

/// The hash that tells the type of an encoded message, to be compared with `Message::getHash()`; empty if there are
/// too few bytes to hold one.
[[nodiscard]] std::optional<std::int64_t> messageHash(Bytes message);

/// The message in untrusted bytes, which must be exactly one. Every length is checked before the generated decoder sees
/// a byte: by itself it throws on a bad length and allocates whatever a hostile one announces.
/// Defined for every type of lcm_types. Allocates: what the message holds, a small multiple of its bytes at most.
/// Threads: a function of its arguments.
template <class Message>
[[nodiscard]] Decoded<Message> decode(Bytes message);

}  // namespace nanomap
