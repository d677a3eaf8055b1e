#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/lcm/convert.h"
#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/pipeline.h"
#include "tools/replay/flight_script.h"

namespace nanomap {

/// A part of a log.
struct LogSpan {
  Duration from{};             ///< after the log's first event
  std::optional<Duration> to;  ///< after the log's first event; empty: to its end
};

/// A plan that is to be made of what was taken in so far.
struct PlanPoint {
  Time log_stamp{};           ///< of the decision
  std::optional<Time> now{};  ///< the time planned for; empty: the snapshot's
  DecisionPlace place{};
};

/// How the order of a recorded flight was followed.
struct StepReport {
  std::uint64_t taken = 0;                                 ///< steps
  std::array<std::uint64_t, kInputKindCount> not_taken{};  ///< messages that were read and that no step took in
  std::vector<RecordingLoss> losses;                       ///< by time
};

/// A log run through a pipeline, one thing after the other. A function of its arguments. Threads: one.
class Playback {
 public:
  virtual ~Playback() = default;
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// Log time of what is taken in next; empty: nothing is left.
  [[nodiscard]] virtual std::optional<Time> nextStamp() const = 0;

  struct Progress {
    Time log_stamp{};
    Pipeline::Outcome outcome;
    std::vector<PlanPoint> plans{};  ///< to be made now, in this order; only where the pipeline has accepted a pose
  };
  /// Takes in what is next. @pre something is left  @throws LogError if it cannot be read
  virtual Progress advance() = 0;

  /// Empty if there is no such order in the log.
  [[nodiscard]] virtual std::optional<StepReport> stepReport() const { return std::nullopt; }

  [[nodiscard]] const Pipeline& pipeline() const { return pipeline_; }
  [[nodiscard]] Time logStart() const { return log_start_; }
  [[nodiscard]] Time logEnd() const { return log_end_; }

  /// All that may be taken in, by log time, and those after the span.
  [[nodiscard]] const std::vector<LogEvent>& events() const { return events_; }

 protected:
  /// Borrows the log.
  /// @throws std::runtime_error if the log holds no event; std::invalid_argument for a configuration that cannot be
  Playback(LogReader& log, const Configuration& configuration, const LogSpan& span);

  [[nodiscard]] InputKind kindOf(const LogEvent& event) const { return *pipeline_.kindOf(log_.channelOf(event)); }

  /// The event's message; valid until the next call.
  [[nodiscard]] Bytes read(const LogEvent& event);

  /// What is said once and holds from then on.
  static constexpr std::array kHeldKinds = {InputKind::kCamera, InputKind::kGoal};
  [[nodiscard]] static bool isHeld(InputKind kind);

  LogReader& log_;
  Pipeline pipeline_;
  std::vector<LogEvent> events_;  ///< of the pipeline's channels, by log time
  Time log_start_{};
  Time log_end_{};
  Time from_{};
  std::optional<Time> to_;

 private:
  std::vector<std::uint8_t> message_;
};

/// By steps if the log is the flight process's own recording, else by arrival. Borrows the log.
/// @throws as its kinds do
[[nodiscard]] std::unique_ptr<Playback> makePlayback(LogReader& log, const Configuration& configuration,
                                                     const LogSpan& span);

}  // namespace nanomap
