#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace nanomap {

using Bytes = std::span<const std::uint8_t>;

/// Reads big-endian integers, as LCM writes them, from bytes that nobody vouches for. Reading past the end fails the
/// cursor for good: whatever is read from then on is zero or empty, and ok() says so.
/// Allocates: no.
class ByteCursor {
 public:
  explicit ByteCursor(Bytes bytes) : rest_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }

  template <std::signed_integral Int>
  [[nodiscard]] Int read() {
    std::make_unsigned_t<Int> value = 0;
    for (const std::uint8_t byte : take(sizeof(Int))) value = static_cast<decltype(value)>((value << 8U) | byte);
    return static_cast<Int>(value);
  }

  /// The next `size` bytes; empty if there are not as many.
  [[nodiscard]] Bytes take(std::size_t size) {
    if (size > rest_.size()) {
      ok_ = false;
      rest_ = {};
      return {};
    }
    const Bytes taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }

 private:
  Bytes rest_;
  bool ok_ = true;
};

}  // namespace nanomap
