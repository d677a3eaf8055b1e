#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"

namespace nanomap {

/// An encoded message as it came in. What it refers to lives as long as the handler that is given it runs.
struct ReceivedMessage {
  std::string_view channel;
  Bytes bytes;                    ///< not looked at yet: decode() judges them
  std::optional<Time> log_stamp;  ///< when it was logged; empty if it comes from a network
};

/// Where messages come from: a network or a recording. Threads: one, unless an implementation says otherwise.
class MessageSource {
 public:
  using Handler = std::function<void(const ReceivedMessage&)>;

  enum class Wait : std::uint8_t {
    kHandled,  ///< at least one message
    kTimeout,  ///< nothing came, or a signal ended the wait
    kEnded,    ///< nothing will ever come again
  };

  virtual ~MessageSource() = default;
  MessageSource(const MessageSource&) = delete;
  MessageSource& operator=(const MessageSource&) = delete;

  /// Waits for a message at most as long as `timeout`, then hands every message that is there to `handler`, in order.
  /// What the handler throws leaves wait(), and loses no message but its own.
  [[nodiscard]] virtual Wait wait(Duration timeout, const Handler& handler) = 0;

 protected:
  MessageSource() = default;
};

}  // namespace nanomap
