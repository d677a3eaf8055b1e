#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "drivers/recording/log_source.h"
#include "firmware_app/flight/flight_process.h"
#include "firmware_app/flight/process_clock.h"
#include "firmware_app/realtime/realtime_facts.h"
#include "tests/unit/firmware_app/flight/shadowing_autopilot.h"

namespace nanomap::test {

/// What the process under test was seen to do.
struct Watched {
  std::map<State, Time> states;  ///< when each was seen first
  SinkReport last;
  std::uint64_t decisions = 0;
  std::vector<std::string> stalls;
};

/// A log, flown by the whole process in real time.
class FlownLog {
 public:
  FlownLog(const std::filesystem::path& log, const Configuration& configuration)
      : source_(LogReader(log), channels(), 1.0, monotonicLogClock()),
        stages_(configuration, Duration::zero(), autopilot),
        process_(options(), source_, stages_) {}

  /// Until the log has ended, or for this long.
  Watched watch(Duration at_most) {
    Watched watched;
    for (const Time end = processNow() + at_most; processNow() < end && !process_.sourceEnded();) {
      sleepUntil(processNow() + std::chrono::milliseconds(20));
      drain(watched);
    }
    return watched;
  }

  [[nodiscard]] const FlightProcess& process() const { return process_; }

  ShadowingAutopilot autopilot;

 private:
  static std::vector<std::string> channels() {
    const LcmParameters lcm;
    std::vector<std::string> channels;
    for (std::size_t i = 0; i < kInputKindCount; ++i) channels.push_back(channelOf(lcm, static_cast<InputKind>(i)));
    return channels;
  }

  FlightOptions options() {
    FlightOptions options;
    options.layout = defaultLayout(gatherRealtimeFacts(1).cores);
    options.demand_realtime = false;
    options.on_message = [this](const ReceivedMessage& message, Time arrival) {
      if (message.channel == LcmParameters{}.pose_channel) autopilot.move(message.bytes, arrival);
    };
    return options;
  }

  void drain(Watched& watched) {
    HandOvers& hand_overs = stages_.hand_overs;
    while (hand_overs.setpoints.pop(
        [&](const SentSetpoint& sent) { watched.states.try_emplace(sent.verdict.state, sent.stamp); })) {
    }
    while (hand_overs.steps.pop([](const Step&) {})) {
    }
    while (hand_overs.decisions.pop([](const MadeDecision&) {})) ++watched.decisions;
    hand_overs.sink_report.take([&](const SinkReport& report) { watched.last = report; });
    for (std::string& stall : process_.takeStalls()) watched.stalls.push_back(std::move(stall));
  }

  LogSource source_;
  Stages stages_;
  FlightProcess process_;
};

inline Configuration logConfiguration() {
  Configuration configuration;
  configuration.lcm.clock = ClockDomain::kLog;
  return configuration;
}

}  // namespace nanomap::test
