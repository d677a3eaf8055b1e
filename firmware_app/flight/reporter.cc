#include "firmware_app/flight/reporter.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <numeric>
#include <utility>

#include "drivers/lcm/encode.h"
#include "firmware_app/flight/process_clock.h"

namespace nanomap {
namespace {

constexpr Duration kHealthPeriod = std::chrono::seconds(1);
constexpr Duration kRound = std::chrono::milliseconds(100);

/// What is still under way when a log has ended needs no longer.
constexpr Duration kAfterTheEnd = std::chrono::seconds(1);

/// A brake takes two seconds, and two more if the vehicle is not seen to stand. The service manager waits for longer
/// (TimeoutStopSec).
constexpr Duration kLongestEnd = std::chrono::seconds(10);

NamedCounters othersOf(const ReportedParts& parts) {
  const LinkCounters link = parts.link.counters();
  const LateFrames late = parts.process.lateFrames();
  NamedCounters others{{"late setpoints", parts.process.lateSetpoints()},
                       {"setpoints held back as stale", link.stale_setpoints},
                       {"late frames: index", late.index},
                       {"late frames: chain", late.chain},
                       {std::string(kLateFrames), late.planner},
                       {std::string(kLostDatagrams), parts.network.loss().datagrams},
                       {"lcm: full queues", parts.network.loss().full_queues}};
  for (const Worker* worker : parts.process.workers()) {
    if (!worker->settings().place) continue;
    others.emplace_back(worker->settings().name + ": page faults",
                        static_cast<std::uint64_t>(worker->usage().faults()));
    others.emplace_back(worker->settings().name + ": allocations", worker->allocations());
  }
  return others;
}

}  // namespace

Reporter::Reporter(const ReportedParts& parts, std::string health_channel)
    : parts_(parts), health_channel_(std::move(health_channel)), monitor_(parts.hand_overs) {}

void Reporter::run(const EndSignals& signals) {
  service_.ready();
  std::optional<Time> ended;
  while (!signals.wait(kRound)) {
    const Time now = processNow();
    round(now);
    if (parts_.process.sourceEnded() && !ended) ended = now;
    if (ended && now - *ended >= kAfterTheEnd) {
      spdlog::info("the source of messages has ended");
      break;
    }
  }
  service_.stopping("ends");
  endFlight(signals);
  spdlog::info("in all: {}", countersLine(monitor_.report(processNow(), others())));
}

void Reporter::round(Time now) {
  monitor_.gather();
  const auto stalls = parts_.process.takeStalls();
  service_.signOfLife(parts_.process.allAnswer(), now);
  if (!stalls.empty()) spdlog::error("{}", fmt::join(stalls, "; "));
  if (now < next_tell_) return;
  next_tell_ = now + kHealthPeriod;
  tell(now);
}

/// An autopilot goes on by the last setpoint for a second or more: one that moves must not be the last.
void Reporter::endFlight(const EndSignals& signals) {
  parts_.hand_overs.ending.store(true, std::memory_order_relaxed);
  const Time latest = processNow() + kLongestEnd;
  const auto moves = [this] { return monitor_.state() == State::kFlying || monitor_.state() == State::kBraking; };
  do {
    if (signals.wait(kRound)) return;
    round(processNow());
  } while (moves() && processNow() < latest);
}

NamedCounters Reporter::others() {
  NamedCounters others = othersOf(parts_);
  if (parts_.recorder != nullptr) tellOfRecording(others);
  return others;
}

void Reporter::tell(Time now) {
  const health_t health = monitor_.report(now, others());
  if (parts_.recorder != nullptr) parts_.recorder->onHealth(health);
  if (!encodeInto(health, encoded_) || !parts_.network.publish(health_channel_, encoded_)) {
    spdlog::warn("the health report was not sent over LCM");
  }
  tellOfOtherAutopilot();
  const std::string line = statusLine(health);
  spdlog::info("{}", line);
  service_.setStatus(line);
}

/// Else one waits for an autopilot that sends all the time; or another vehicle flies by our poses.
void Reporter::tellOfOtherAutopilot() {
  const auto other = parts_.link.otherAutopilot();
  if (other == other_autopilot_told_) return;
  other_autopilot_told_ = other;
  if (!other) return;
  spdlog::warn(
      "the autopilot of system {} is heard, which is not mavlink.system_id: it gets no setpoint, but hears what "
      "is for everyone (ODOMETRY, OBSTACLE_DISTANCE)",
      *other);
}

void Reporter::tellOfRecording(NamedCounters& others) {
  parts_.recorder->report().take([this](const RecorderReport& report) { recording_ = report; });
  const auto& dropped = recording_.dropped;
  others.emplace_back("recorder: dropped", std::accumulate(dropped.begin(), dropped.end(), std::uint64_t{0}));
  others.emplace_back("recorder: lost by the disk", recording_.log.events_lost);
  if (recording_.fault == recording_fault_told_) return;
  recording_fault_told_ = recording_.fault;
  if (recording_.fault.empty()) {
    spdlog::info("recording again");
  } else {
    spdlog::error("not recording: {}", recording_.fault);
  }
}

}  // namespace nanomap
