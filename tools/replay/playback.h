#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/pipeline.h"

namespace nanomap {

/// A part of a log.
struct LogSpan {
  Duration from{};             ///< after the log's first event
  std::optional<Duration> to;  ///< after the log's first event; empty: to its end
};

/// A log run through a pipeline, event by event, merged by log time. What is said once and holds from then on, camera
/// models and goals, is taken in from before the span too. A function of its arguments. Threads: one.
class Playback {
 public:
  /// Borrows the log.
  /// @throws std::runtime_error if the log holds no event; std::invalid_argument for a configuration that cannot be
  Playback(LogReader& log, const Configuration& configuration, const LogSpan& span);

  /// Log time of the next event; empty: none is left.
  [[nodiscard]] std::optional<Time> nextStamp() const;

  struct Step {
    Time log_stamp{};
    Pipeline::Outcome outcome;
  };
  /// Takes in the next event. @pre one is left  @throws LogError if it cannot be read
  Step step();

  [[nodiscard]] const Pipeline& pipeline() const { return pipeline_; }
  [[nodiscard]] Time logStart() const { return log_start_; }
  [[nodiscard]] Time logEnd() const { return log_end_; }

  /// All that are taken in, by log time, and those after the span.
  [[nodiscard]] const std::vector<LogEvent>& events() const { return events_; }

 private:
  LogReader& log_;
  Pipeline pipeline_;
  std::vector<LogEvent> events_;
  Time log_start_{};
  Time log_end_{};
  std::optional<Time> to_;
  std::size_t next_ = 0;
  std::vector<std::uint8_t> message_;
};

}  // namespace nanomap
