#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/message_source.h"
#include "drivers/recording/log_reader.h"

namespace nanomap {

/// A pause of a log that is longer is cut to this: such logs were written while a clock was set. Long enough for every
/// time limit of a flight to pass.
inline constexpr Duration kLongestLogPause = std::chrono::seconds(10);

/// The clock that a log is played by.
struct LogClock {
  std::function<Time()> now;
  std::function<void(Time)> wait_until;  ///< may return early, as it does at a signal
};

/// The monotonic clock of this machine.
[[nodiscard]] LogClock monotonicLogClock();

/// Plays a log as it was recorded: by log time, at a multiple of its speed, from the first call of wait() on. What
/// nobody waited for in time comes at once, with nothing left out.
class LogSource : public MessageSource {
 public:
  /// @param channels  to be played; the log's other channels are passed over
  /// @param rate      log time per real time, positive
  /// @throws std::invalid_argument naming the rate
  LogSource(LogReader log, const std::vector<std::string>& channels, double rate, LogClock clock);

  /// Reads the file: for the bench, not for a real-time thread.
  [[nodiscard]] Wait wait(Duration timeout, const Handler& handler) override;

  /// Messages that could not be read any more, since the file has changed.
  [[nodiscard]] std::uint64_t unreadable() const { return unreadable_; }

  /// What the log itself has lost.
  [[nodiscard]] const std::vector<LogDamage>& damage() const { return log_.damage(); }

 private:
  struct Item {
    LogEvent event;
    Duration due{};  ///< since the start of playing
  };

  /// The event's message into message_; false if it cannot be read any more.
  [[nodiscard]] bool read(const LogEvent& event);

  LogReader log_;
  LogClock clock_;
  std::vector<Item> items_;  ///< by log time
  std::size_t next_ = 0;
  std::optional<Time> start_;
  std::vector<std::uint8_t> bytes_;  ///< storage that is used again
  ReceivedMessage message_;
  std::uint64_t unreadable_ = 0;
};

}  // namespace nanomap
