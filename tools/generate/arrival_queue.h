#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"

namespace nanomap::generate {

/// Holds messages back until it is known that none will arrive before them: they are made in the order of what they
/// describe, and delivered in the order of their arrival. Ties keep the order of their making. Threads: one.
class ArrivalQueue {
 public:
  using Deliver = std::function<void(const std::string& channel, Time arrival, Bytes message)>;

  template <typename Message>
  void add(const std::string& channel, Time arrival, const Message& message) {
    std::vector<std::uint8_t> encoded(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
    ++counts_[channel];
    pending_.emplace(arrival, std::pair(channel, std::move(encoded)));
  }

  /// Delivers what arrives before `time`.
  void deliverUntil(Time time, const Deliver& deliver) {
    while (!pending_.empty() && pending_.begin()->first < time) {
      const auto next = pending_.extract(pending_.begin());
      deliver(next.mapped().first, next.key(), next.mapped().second);
    }
  }

  /// Messages added, by channel.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  std::multimap<Time, std::pair<std::string, std::vector<std::uint8_t>>> pending_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace nanomap::generate
