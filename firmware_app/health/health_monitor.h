#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_app/health/latency_histogram.h"
#include "firmware_app/stages/hand_overs.h"
#include "nanomap/health_t.hpp"

namespace nanomap {

/// Counters that come from elsewhere than the stages' hand-overs: names in words, as they are shown.
using NamedCounters = std::vector<std::pair<std::string, std::uint64_t>>;

/// Names among those that the line on the terminal tells, too.
inline constexpr std::string_view kLostDatagrams = "lcm: datagrams lost";
inline constexpr std::string_view kLateFrames = "late frames: planner";

/// Gathers how the process is, from what the stages put into their hand-overs for it: state, ages, latencies since the
/// last report and counters since the start. Threads: one. Allocates.
class HealthMonitor {
 public:
  /// Borrows.
  explicit HealthMonitor(HandOvers& hand_overs) : hand_overs_(hand_overs) {}

  /// To be called often enough that no queue of measured times is full: at 4 Hz or faster.
  void gather();

  /// What has been gathered; latencies begin anew. @param others  shown as they are
  [[nodiscard]] health_t report(Time now, const NamedCounters& others);

  /// Of the last round of the sink that has been gathered.
  [[nodiscard]] State state() const { return sink_.verdict.state; }

 private:
  enum Latency : std::size_t { kIndex, kChain, kPlan, kExposureToSetpoint, kLatencyCount };

  void addCounters(health_t& health, const NamedCounters& others) const;

  HandOvers& hand_overs_;
  std::array<LatencyHistogram, kLatencyCount> latencies_;
  IngestCounters ingest_;
  IndexCounters index_;
  ChainStageCounters chain_;
  SinkReport sink_;
  std::optional<MadeDecision> decision_;
  std::int64_t sequence_ = 0;
};

/// The same in one line, for a terminal: state, reason, ages, latencies, what was lost.
[[nodiscard]] std::string statusLine(const health_t& health);

/// Every counter that is not zero, in one line: what there was in all, for the end.
[[nodiscard]] std::string countersLine(const health_t& health);

}  // namespace nanomap
