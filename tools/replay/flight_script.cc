#include "tools/replay/flight_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "nanomap/decision_t.hpp"
#include "nanomap/lost_t.hpp"

namespace nanomap {
namespace {

std::string range(std::uint64_t first, std::uint64_t last) {
  return first == last ? fmt::format("{}", first) : fmt::format("{} .. {}", first, last);
}

/// A message of that type, if the bytes are one.
template <class Message>
std::optional<Message> decoded(const std::vector<std::uint8_t>& bytes) {
  Decoded<Message> message = decode<Message>(bytes);
  return std::holds_alternative<Message>(message) ? std::optional(std::get<Message>(std::move(message))) : std::nullopt;
}

std::optional<RecordedPlan> toPlan(const decision_t& decision, Time log_stamp) {
  const Converted<Time> now = timeFromUtime(decision.utime);
  if (!std::holds_alternative<Time>(now) || decision.sequence < 0 || decision.step < 1) return std::nullopt;
  return RecordedPlan{.log_stamp = log_stamp,
                      .now = std::get<Time>(now),
                      .sequence = static_cast<std::uint64_t>(decision.sequence),
                      .step = static_cast<std::uint64_t>(decision.step),
                      .flown = decision.flown != 0};
}

class ScriptReader {
 public:
  explicit ScriptReader(const LcmParameters& lcm) : lcm_(lcm) {}

  void read(const std::string& channel, Time log_stamp, const std::vector<std::uint8_t>& bytes) {
    if (channel == lcm_.steps_channel) {
      const auto message = decoded<step_t>(bytes);
      if (const auto step = message ? toStep(*message) : std::nullopt) script_.steps.push_back(*step);
    } else if (channel == lcm_.decisions_channel) {
      const auto message = decoded<decision_t>(bytes);
      if (const auto plan = message ? toPlan(*message, log_stamp) : std::nullopt) script_.plans.push_back(*plan);
    } else if (channel == lcm_.lost_channel) {
      const auto message = decoded<lost_t>(bytes);
      if (message) lose(log_stamp, fmt::format("{} {} were not recorded", message->count, message->tap));
    }
  }

  [[nodiscard]] FlightScript finish() && {
    if (script_.steps.empty()) return {};
    sortSteps();
    sortPlans();
    std::stable_sort(script_.losses.begin(), script_.losses.end(),
                     [](const RecordingLoss& a, const RecordingLoss& b) { return a.at < b.at; });
    return std::move(script_);
  }

 private:
  void lose(Time at, std::string what) { script_.losses.push_back({at, std::move(what)}); }

  void sortSteps() {
    auto& steps = script_.steps;
    std::stable_sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.number < b.number; });
    const auto repeated = [](const Step& a, const Step& b) {
      if (a.number == b.number && (a.taken != b.taken || a.kind != b.kind || a.arrival != b.arrival)) {
        throw std::runtime_error("the logs hold the steps of two flights: give those of one");
      }
      return a.number == b.number;
    };
    steps.erase(std::unique(steps.begin(), steps.end(), repeated), steps.end());

    std::uint64_t expected = 1;
    for (const Step& step : steps) {
      if (step.number > expected) lose(step.taken, "steps " + range(expected, step.number - 1) + " are missing");
      expected = step.number + 1;
    }
  }

  void sortPlans() {
    auto& plans = script_.plans;
    std::stable_sort(plans.begin(), plans.end(),
                     [](const RecordedPlan& a, const RecordedPlan& b) { return a.sequence < b.sequence; });
    plans.erase(std::unique(plans.begin(), plans.end(),
                            [](const RecordedPlan& a, const RecordedPlan& b) { return a.sequence == b.sequence; }),
                plans.end());

    std::uint64_t expected = 0;
    for (const RecordedPlan& plan : plans) {
      if (plan.sequence > expected) {
        lose(plan.log_stamp, "decisions " + range(expected, plan.sequence - 1) + " are missing");
      }
      expected = plan.sequence + 1;
    }
    const std::uint64_t last_step = script_.steps.back().number;
    if (!plans.empty() && plans.back().step > last_step) {
      lose(plans.back().log_stamp, "steps " + range(last_step + 1, plans.back().step) + " are missing");
    }
  }

  const LcmParameters& lcm_;
  FlightScript script_;
};

}  // namespace

FlightScript readFlightScript(LogReader& log, const LcmParameters& lcm) {
  ScriptReader reader(lcm);
  std::vector<std::uint8_t> bytes;
  for (const LogEvent& event : log.events()) {
    const std::string& channel = log.channelOf(event);
    if (channel != lcm.steps_channel && channel != lcm.decisions_channel && channel != lcm.lost_channel) continue;
    log.read(event, bytes);
    reader.read(channel, event.log_stamp, bytes);
  }
  return std::move(reader).finish();
}

}  // namespace nanomap
