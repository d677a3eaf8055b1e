#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"
#include "drivers/recording/log_segment.h"
#include "drivers/recording/log_writer.h"

namespace nanomap {

/// How much of a disk recordings may take.
struct RotationLimits {
  std::uint64_t segment_bytes = 0;  ///< at most, of one file
  std::uint64_t total_bytes = 0;    ///< at most, of all recordings in the folder, those of earlier flights included
};

struct RotatingLogCounters {
  std::uint64_t events_written = 0;  ///< handed to the operating system; heads of segments not included
  std::uint64_t events_lost = 0;     ///< at most: of those between the last flush and a fault, some may be in the log
  std::uint64_t segments_begun = 0;
  std::uint64_t segments_deleted = 0;
};

/// Whether an event says something that goes on to hold.
enum class Retention : std::uint8_t {
  kOnce,
  kHolds,  ///< until the next one on its channel: a camera model, a goal, the configuration
};

/// Records a flight as LCM logs of bounded size in a folder, and deletes the oldest recordings so that all of them
/// together stay bounded. Each log is readable on its own: what held when it was begun stands at its head, stamped as
/// its first event.
///
/// A flight does not end because its recording does: once constructed, nothing here throws for what the disk does. A
/// fault is counted and named; what cannot be written is lost, until keepUp() finds that there is room again.
/// Threads: one. Allocates.
class RotatingLog {
 public:
  /// Events reach the operating system this long after they were written, if keepUp() is called as often.
  static constexpr Duration kFlushPeriod = std::chrono::milliseconds(500);

  /// Makes the folder if need be, and begins a flight, numbered on from the latest one there.
  /// @throws LogError naming the folder if it cannot be made, read or written, or the disk is full;
  ///         std::invalid_argument if the limits leave no room for two segments
  RotatingLog(std::filesystem::path folder, const RotationLimits& limits, Time now);

  /// Closes without a word about errors, if close() was not called.
  ~RotatingLog();

  RotatingLog(const RotatingLog&) = delete;
  RotatingLog& operator=(const RotatingLog&) = delete;

  /// False if the event is lost: the disk is full, the folder gone, the event larger than a segment or its channel's
  /// name one that no log can hold.
  [[nodiscard]] bool write(const std::string& channel, Time log_stamp, Bytes message,
                           Retention retention = Retention::kOnce);

  /// To be called several times in each kFlushPeriod. Flushes when it is due; after a fault, tries again.
  void keepUp(Time now);

  /// Flushes and ends the recording. What is written later is lost.
  void close();

  /// What is wrong with the disk, and what to do; empty: nothing.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] const RotatingLogCounters& counters() const { return counters_; }
  [[nodiscard]] std::uint32_t flight() const { return next_.flight; }

  /// Of the segment that is being written, or was last.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct Held {
    std::string channel;
    std::vector<std::uint8_t> message;
  };

  /// Runs what may throw for the disk's sake. False if it did: the segment is given up.
  template <class Action>
  bool attempt(Action&& action);

  void begin();
  void deleteOldest();
  void append(const std::string& channel, Time log_stamp, Bytes message);
  void flush();
  void giveUp(const std::string& fault);
  void hold(const std::string& channel, Bytes message);

  /// Of the events at the head of a segment whose first event is on `channel`: it holds instead of what held there.
  [[nodiscard]] std::uint64_t headBytes(const std::string& channel) const;
  void writeHead(Time log_stamp, const std::string& channel);

  std::filesystem::path folder_;
  RotationLimits limits_;
  SegmentName next_;  ///< to be begun
  std::filesystem::path path_;
  std::optional<LogWriter> segment_;  ///< empty: closed, or a fault is in the way
  std::uint64_t segment_bytes_ = 0;
  bool holds_events_ = false;  ///< the segment does, flushed: else a fault leaves nothing of it behind
  std::uint64_t unflushed_events_ = 0;
  bool closed_ = false;
  Time flushed_at_{};  ///< or tried again
  std::vector<Held> held_;
  std::string fault_;
  RotatingLogCounters counters_;
};

}  // namespace nanomap
