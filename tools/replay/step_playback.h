#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "tools/replay/playback.h"

namespace nanomap {

/// A recording of the flight process, as it flew: messages are read in the order of their arrival, which gives them
/// their numbers and epochs, and taken in by the recorded steps; plans are made where the recorded decisions were. So a
/// recording without losses leads to the same decisions, byte for byte.
/// Where the recording's beginning is gone, what was said there and goes on to hold is taken in first, if it stands at
/// the head of a later part. A span that does not begin at the start leaves the steps before it out, but for those
/// kinds.
class StepPlayback final : public Playback {
 public:
  /// @param script  of this log; has steps
  StepPlayback(LogReader& log, const Configuration& configuration, const LogSpan& span, FlightScript script);

  [[nodiscard]] std::optional<Time> nextStamp() const override;
  Progress advance() override;
  [[nodiscard]] std::optional<StepReport> stepReport() const override { return report_; }

 private:
  /// What tells one message from all others.
  using Key = std::pair<InputKind, Time>;
  [[nodiscard]] static Key keyOf(const Step& step) { return {step.kind, step.arrival}; }

  /// Reads every message that had arrived by then, and keeps what a step takes in.
  void readUpTo(Time arrival);
  void takeWhatHeld(InputKind kind);
  [[nodiscard]] bool plansAreDue() const;
  void lose(Time at, std::string what);

  std::vector<Step> steps_;
  std::vector<RecordedPlan> plans_;
  StepReport report_;
  std::set<Key> wanted_;          ///< messages that a step takes in
  std::map<Key, Input> waiting_;  ///< those of them that were read, until their step
  std::size_t next_event_ = 0;
  std::size_t next_step_ = 0;
  std::size_t next_plan_ = 0;
};

}  // namespace nanomap
