#include "drivers/lcm/decode.h"

#include <cassert>
#include <limits>

#include "drivers/lcm/message_layout.h"
#include "drivers/lcm/message_types.h"

namespace nanomap {
namespace {

constexpr std::size_t kHashBytes = sizeof(std::int64_t);

/// The generated code counts bytes in int.
constexpr std::size_t kMaxMessageBytes = std::numeric_limits<int>::max();

}  // namespace

std::string_view toString(DecodeFault fault) {
  switch (fault) {
    case DecodeFault::kWrongType:
      return "wrong type";
    case DecodeFault::kTruncated:
      return "truncated";
    case DecodeFault::kBadLength:
      return "bad length";
    case DecodeFault::kTrailingBytes:
      return "trailing bytes";
  }
  return "?";
}

std::optional<std::int64_t> messageHash(Bytes message) {
  ByteCursor cursor(message);
  const auto hash = cursor.read<std::int64_t>();
  return cursor.ok() ? std::optional(hash) : std::nullopt;
}

template <class Message>
Decoded<Message> decode(Bytes message) {
  const std::optional<std::int64_t> hash = messageHash(message);
  if (!hash) return DecodeFault::kTruncated;
  if (*hash != Message::getHash()) return DecodeFault::kWrongType;
  if (message.size() > kMaxMessageBytes) return DecodeFault::kBadLength;
  if (const auto fault = checkLayout<Message>(message.subspan(kHashBytes))) return *fault;

  Message decoded{};
  const int size = static_cast<int>(message.size());
  [[maybe_unused]] const int consumed = decoded.decode(message.data(), 0, size);
  assert(consumed == size);  // the layout is checked: the generated decoder reads what it describes
  return decoded;
}

#define NANOMAP_INSTANTIATE(Message) template Decoded<Message> decode<Message>(Bytes);
NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_INSTANTIATE)
#undef NANOMAP_INSTANTIATE

}  // namespace nanomap
