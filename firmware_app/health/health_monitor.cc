#include "firmware_app/health/health_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

/// As health_t has it: NaN is "none yet".
double seconds(const std::optional<Duration>& duration) {
  return duration ? toSeconds(*duration) : std::numeric_limits<double>::quiet_NaN();
}

template <class Counters>
std::uint64_t sumOf(const Counters& counters) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : counters) sum += count;
  return sum;
}

class CounterList {
 public:
  explicit CounterList(health_t& health) : health_(health) {}

  void add(std::string name, std::int64_t value) {
    counter_t counter;
    counter.name = std::move(name);
    counter.value = value;
    health_.counters.push_back(std::move(counter));
  }
  void add(std::string name, std::uint64_t value) { add(std::move(name), static_cast<std::int64_t>(value)); }
  /// Faults are listed once they have happened.
  void addIfAny(std::string name, std::uint64_t value) {
    if (value > 0) add(std::move(name), value);
  }
  /// One of each value of an enumeration, with its words.
  template <class Enum, class Counters>
  void addEach(const std::string& prefix, const Counters& counters) {
    for (std::size_t i = 0; i < counters.size(); ++i) {
      addIfAny(prefix + std::string(toString(static_cast<Enum>(i))), counters[i]);
    }
  }

 private:
  health_t& health_;
};

std::string reasonOf(const SinkReport& sink, const std::optional<MadeDecision>& decision) {
  if (sink.verdict.faults.any()) return "without: " + sink.verdict.faults.words();
  std::string reason(toString(sink.reason));
  if (!decision) return reason;
  const Decision& made = decision->decision;
  const VetoCounts& vetoes = made.vetoes;
  if (made.evaluated == 0 || made.feasible == made.evaluated) return reason;
  reason += fmt::format(" ({} of {} motions refused", made.evaluated - made.feasible, made.evaluated);
  if (vetoes.by_neighbours > 0) reason += fmt::format(", too near {}", vetoes.by_neighbours);
  for (std::size_t i = 0; i < vetoes.by_status.size(); ++i) {
    if (vetoes.by_status[i] > 0)
      reason += fmt::format(", {} {}", toString(static_cast<Status>(i)), vetoes.by_status[i]);
  }
  return reason + ")";
}

std::string milliseconds(double time_s) { return time_s == time_s ? fmt::format("{:.0f} ms", 1e3 * time_s) : "none"; }

std::int64_t counterOf(const health_t& health, std::string_view name) {
  const auto found = std::find_if(health.counters.begin(), health.counters.end(),
                                  [name](const counter_t& counter) { return counter.name == name; });
  return found == health.counters.end() ? 0 : found->value;
}

constexpr std::string_view kDropped = "dropped on the way";
constexpr std::string_view kClockSet = "time of day: set";
constexpr std::string_view kClockSetBy = "time of day: last set by, in ms";

/// Streams whose loss is told.
constexpr std::array kCountedStreams = {InputKind::kDepth, InputKind::kPose, InputKind::kCorrection};

std::string missingOf(InputKind kind) { return std::string(toString(kind)) + ": missing"; }
std::string suspectedOf(InputKind kind) { return std::string(toString(kind)) + ": suspected missing"; }

/// "depth frames 10, datagrams 33", of what is not zero.
std::string lostOf(const health_t& health) {
  std::string lost;
  const auto add = [&lost](std::string_view what, std::int64_t count) {
    if (count == 0) return;
    if (!lost.empty()) lost += ", ";
    lost += fmt::format("{} {}", what, count);
  };
  for (const InputKind kind : kCountedStreams) {
    add(toString(kind), counterOf(health, missingOf(kind)) + counterOf(health, suspectedOf(kind)));
  }
  add("datagrams", counterOf(health, kLostDatagrams));
  return lost;
}

}  // namespace

void HealthMonitor::gather() {
  const auto drain = [this](SlotQueue<Duration>& times, Latency latency) {
    while (times.pop([&](Duration time) { latencies_[latency].record(time); })) {
    }
  };
  drain(hand_overs_.index_times, kIndex);
  drain(hand_overs_.chain_times, kChain);
  drain(hand_overs_.plan_times, kPlan);
  drain(hand_overs_.setpoint_latencies, kExposureToSetpoint);
  hand_overs_.ingest_counters.take([this](const IngestCounters& counters) { ingest_ = counters; });
  hand_overs_.index_counters.take([this](const IndexCounters& counters) { index_ = counters; });
  hand_overs_.chain_counters.take([this](const ChainStageCounters& counters) { chain_ = counters; });
  hand_overs_.sink_report.take([this](const SinkReport& report) { sink_ = report; });
  hand_overs_.newest_decision.take([this](const MadeDecision& decision) { decision_ = decision; });
}

health_t HealthMonitor::report(Time now, const NamedCounters& others) {
  gather();
  health_t health;
  health.utime = utimeFromTime(now);
  health.sequence = sequence_++;
  health.state = toString(sink_.verdict.state);
  health.reason = reasonOf(sink_, decision_);
  health.depth_age = seconds(sink_.depth_age);
  health.pose_age = seconds(sink_.pose_age);
  health.decision_age = seconds(sink_.plan_age);

  constexpr std::array<std::string_view, kLatencyCount> kNames = {"index", "chain", "plan", "exposure to setpoint"};
  for (std::size_t i = 0; i < kLatencyCount; ++i) {
    latency_t latency;
    latency.name = kNames[i];
    latency.count = static_cast<std::int64_t>(latencies_[i].count());
    latency.p50 = toSeconds(latencies_[i].quantile(0.5));
    latency.p99 = toSeconds(latencies_[i].quantile(0.99));
    latency.max = toSeconds(latencies_[i].max());
    health.latencies.push_back(std::move(latency));
    latencies_[i] = LatencyHistogram();
  }
  health.num_latencies = static_cast<std::int32_t>(health.latencies.size());
  addCounters(health, others);
  health.num_counters = static_cast<std::int32_t>(health.counters.size());
  return health;
}

void HealthMonitor::addCounters(health_t& health, const NamedCounters& others) const {
  CounterList list(health);
  for (std::size_t i = 0; i < kInputKindCount; ++i) {
    const std::string kind(toString(static_cast<InputKind>(i)));
    list.add(kind, ingest_.messages[i]);
    list.addEach<DecodeFault>(kind + ": ", ingest_.decode_faults[i]);
    list.addEach<ConvertFault>(kind + ": ", ingest_.convert_faults[i]);
    list.addIfAny(missingOf(static_cast<InputKind>(i)), ingest_.loss[i].missing);
    list.addIfAny(suspectedOf(static_cast<InputKind>(i)), ingest_.loss[i].suspected);
    list.addIfAny(kind + ": repeated", ingest_.loss[i].repeated);
    list.addIfAny(kind + ": late", ingest_.loss[i].late);
    list.addIfAny(kind + ": began again", ingest_.loss[i].began_again);
    list.addIfAny(kind + ": ahead of our clock", ingest_.from_future[i]);
    list.addIfAny(kind + ": before the log's clock was known", ingest_.before_clock[i]);
  }
  if (ingest_.clock_steps > 0) {
    list.add(std::string(kClockSet), ingest_.clock_steps);
    list.add(std::string(kClockSetBy),
             std::chrono::duration_cast<std::chrono::milliseconds>(ingest_.last_clock_step).count());
  }
  list.add("views", index_.views);
  list.addEach<ImageFault>("frames: ", index_.image_faults);
  list.addEach<CameraFault>("frames: ", index_.camera_faults);
  const ChainCounters& chain = chain_.chain;
  list.addEach<ViewDrop>("views: ", chain.views_dropped);
  list.addIfAny("views: of a camera that is stuck", chain_.stuck_views);
  for (std::size_t i = 1; i < chain.poses.size(); ++i) {
    list.addIfAny("poses: " + std::string(toString(static_cast<PoseVerdict>(i))), chain.poses[i]);
  }
  for (std::size_t i = 1; i < chain.corrections.size(); ++i) {
    list.addIfAny("corrections: " + std::string(toString(static_cast<CorrectionVerdict>(i))), chain.corrections[i]);
  }
  list.add("decisions", decision_ ? decision_->sequence + 1 : 0);
  list.add("setpoints", sink_.counters.setpoints);
  list.addIfAny("setpoints: refused by the link", sink_.counters.setpoints_failed);
  list.addIfAny("plans: of a motion that cannot be flown", sink_.counters.plans_refused);

  const std::uint64_t dropped = hand_overs_.inputs.dropped() + hand_overs_.cameras.dropped() +
                                hand_overs_.captured.dropped() + hand_overs_.indexed.dropped() +
                                hand_overs_.vehicle.dropped();
  list.add(std::string(kDropped), dropped);
  list.addIfAny("dropped: for the chain", hand_overs_.inputs.dropped());
  list.addIfAny("dropped: camera models for the index", hand_overs_.cameras.dropped());
  list.addIfAny("dropped: frames for the index", hand_overs_.captured.dropped());
  list.addIfAny("dropped: views for the chain", hand_overs_.indexed.dropped());
  list.addIfAny("dropped: poses for the sink", hand_overs_.vehicle.dropped());
  list.addIfAny("replaced: frames by newer ones", hand_overs_.frames.replaced());
  list.addIfAny("replaced: snapshots by newer ones", hand_overs_.moments.replaced());
  for (const auto& [name, value] : others) list.add(name, value);
}

std::string statusLine(const health_t& health) {
  std::string line =
      fmt::format("{:8} {} | depth {}, pose {}, plan {}", health.state, health.reason, milliseconds(health.depth_age),
                  milliseconds(health.pose_age), milliseconds(health.decision_age));
  for (const latency_t& latency : health.latencies) {
    if (latency.count == 0) continue;
    line += fmt::format(" | {} {:.2f}/{:.2f} ms", latency.name, 1e3 * latency.p50, 1e3 * latency.p99);
  }
  if (const std::int64_t dropped = counterOf(health, kDropped); dropped > 0)
    line += fmt::format(" | dropped {}", dropped);
  if (const std::string lost = lostOf(health); !lost.empty()) line += " | lost: " + lost;
  if (const std::int64_t late = counterOf(health, kLateFrames); late > 0)
    line += fmt::format(" | late frames {}", late);
  if (const std::int64_t set = counterOf(health, kClockSet); set > 0) {
    line += fmt::format(" | time of day set {} x, by {:+} ms", set, counterOf(health, kClockSetBy));
  }
  return line;
}

std::string countersLine(const health_t& health) {
  std::string line;
  for (const counter_t& counter : health.counters) {
    if (counter.value == 0) continue;
    if (!line.empty()) line += ", ";
    line += fmt::format("{} {}", counter.name, counter.value);
  }
  return line;
}

}  // namespace nanomap
