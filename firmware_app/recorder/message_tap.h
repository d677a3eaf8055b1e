#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"
#include "drivers/recording/log_header.h"
#include "firmware_app/handover/slot_queue.h"

namespace nanomap {

/// Messages of any size on their way from the thread that received them to the one that records them, in a ring of
/// bytes. Neither end waits or locks, and the first does not allocate: the second has a buffer that grows to the
/// largest message. What finds no room is dropped, which is counted. Threads: one pushes, one pops; the counter from
/// any.
class MessageTap {
 public:
  /// @param messages  room for as many,
  /// @param bytes     of as many bytes in all
  MessageTap(std::size_t messages, std::size_t bytes) : headers_(messages), bytes_(bytes) {}

  /// Producer. False if it was dropped; so is one whose channel no log can hold.
  bool push(std::string_view channel, Time arrival, Bytes message) {
    const bool fits = channel.size() <= kMaxChannelBytes && bytes_.write_available() >= message.size();
    const bool pushed = fits && headers_.push([&](Header& header) {
      header.arrival = arrival;
      header.channel_bytes = channel.size();
      std::copy(channel.begin(), channel.end(), header.channel.begin());
      header.message_bytes = message.size();
      bytes_.push(message.data(), message.size());
    });
    if (!pushed) dropped_.fetch_add(1, std::memory_order_relaxed);
    return pushed;
  }

  /// Consumer: lets `use(std::string_view channel, Time arrival, Bytes message)` have the oldest. False if there is
  /// none.
  template <class Use>
  bool pop(Use&& use) {
    return headers_.pop([&](const Header& header) {
      if (popped_.size() < header.message_bytes) popped_.resize(header.message_bytes);
      bytes_.pop(popped_.data(), header.message_bytes);
      use(std::string_view(header.channel.data(), header.channel_bytes), header.arrival,
          Bytes(popped_).first(header.message_bytes));
    });
  }

  [[nodiscard]] std::size_t capacity() const { return headers_.capacity(); }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  struct Header {
    Time arrival{};
    std::size_t message_bytes = 0;
    std::size_t channel_bytes = 0;
    std::array<char, kMaxChannelBytes> channel{};
  };

  SlotQueue<Header> headers_;
  boost::lockfree::spsc_queue<std::uint8_t> bytes_;  ///< those of a header are there before it is
  std::vector<std::uint8_t> popped_;                 ///< the consumer's
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace nanomap
