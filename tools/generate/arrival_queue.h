#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "core/time.h"
#include "drivers/recording/log_writer.h"

namespace nanomap::generate {

/// Holds messages back until it is known that none will arrive before them: they are made in the order of what they
/// describe, and written in the order of their arrival. Ties keep the order of their making. Threads: one.
class ArrivalQueue {
 public:
  explicit ArrivalQueue(LogWriter& log) : log_(&log) {}

  template <typename Message>
  void add(const std::string& channel, Time arrival, Message message) {
    ++counts_[channel];
    pending_.emplace(arrival, [channel, arrival, message = std::move(message)](LogWriter& log) {
      log.write(channel, arrival, message);
    });
  }

  /// Writes what arrives before `time`.
  void writeUntil(Time time) { writeWhile(pending_.lower_bound(time)); }

  void writeAll() { writeWhile(pending_.end()); }

  /// Messages added, by channel.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  using Pending = std::multimap<Time, std::function<void(LogWriter&)>>;

  void writeWhile(Pending::iterator end) {
    for (auto next = pending_.begin(); next != end; next = pending_.erase(next)) next->second(*log_);
  }

  LogWriter* log_;
  Pending pending_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace nanomap::generate
