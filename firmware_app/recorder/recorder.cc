#include "firmware_app/recorder/recorder.h"

#include "drivers/lcm/convert.h"
#include "drivers/lcm/encode.h"
#include "firmware_app/configuration/document.h"
#include "firmware_app/recorder/setpoint_message.h"
#include "nanomap/lost_t.hpp"
#include "nanomap/text_t.hpp"

namespace nanomap {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

/// Two seconds of everything at its fastest: 400 poses, 100 corrections and 60 frames a second.
constexpr std::size_t kMessages = 1200;
constexpr std::size_t kHealthReports = 4;

RotationLimits limitsOf(const RecorderParameters& parameters) {
  return {.segment_bytes = parameters.segment_mb * kMegabyte, .total_bytes = parameters.total_mb * kMegabyte};
}

}  // namespace

std::string_view toString(Tap tap) {
  switch (tap) {
    case Tap::kMessages:
      return "messages";
    case Tap::kSteps:
      return "steps";
    case Tap::kDecisions:
      return "decisions";
    case Tap::kSetpoints:
      return "setpoints";
    case Tap::kHealth:
      return "health reports";
  }
  return "?";
}

Recorder::Recorder(const std::filesystem::path& folder, const Configuration& configuration, const RecorderPorts& ports,
                   Time now)
    : lcm_(configuration.lcm),
      ports_(ports),
      log_(folder, limitsOf(configuration.recorder), now),
      messages_(kMessages, configuration.recorder.buffer_mb * kMegabyte),
      health_(kHealthReports) {
  text_t text{};
  text.utime = utimeFromTime(now);
  text.text = annotatedToml(configuration);
  put(std::string(kConfigurationChannel), now, text, Retention::kHolds);
}

void Recorder::onMessage(std::string_view channel, Time arrival, Bytes message) {
  messages_.push(channel, arrival, message);
}

void Recorder::onHealth(const health_t& health) {
  health_.push([&](health_t& slot) { slot = health; });
}

void Recorder::run(Time now) {
  writeMessages();
  writeAll(ports_.steps);
  writeAll(ports_.decisions);
  writeAll(ports_.setpoints);
  while (health_.pop([this](const health_t& health) {
    put(lcm_.health_channel, Time(std::chrono::microseconds(health.utime)), health);
  })) {
  }
  tellLosses(now);
  log_.keepUp(now);
  report_.put([this](RecorderReport& slot) { slot = {dropped(), log_.counters(), log_.fault()}; });
}

void Recorder::close(Time now) {
  run(now);
  log_.close();
}

void Recorder::writeMessages() {
  const auto record = [this](std::string_view channel, Time arrival, Bytes message) {
    channel_ = channel;
    const bool holds = channel == lcm_.camera_channel || channel == lcm_.goal_channel;
    static_cast<void>(log_.write(channel_, arrival, message, holds ? Retention::kHolds : Retention::kOnce));
  };
  for (std::size_t i = 0; i < messages_.capacity() && messages_.pop(record); ++i) {
  }
}

template <class T>
void Recorder::writeAll(SlotQueue<T>& queue) {
  for (std::size_t i = 0; i < queue.capacity() && queue.pop([this](const T& value) { write(value); }); ++i) {
  }
}

void Recorder::write(const Step& step) { put(lcm_.steps_channel, step.taken, toMessage(step)); }

void Recorder::write(const MadeDecision& made) {
  put(lcm_.decisions_channel, made.decision.stamp,
      toMessage(made.decision, {.sequence = made.sequence, .step = made.step, .flown = made.flown}));
}

void Recorder::write(const SentSetpoint& setpoint) {
  if (std::string state = stateInWords(setpoint.verdict); state != state_) {
    text_t text{};
    text.utime = utimeFromTime(setpoint.stamp);
    text.text = state;
    put(lcm_.state_channel, setpoint.stamp, text, Retention::kHolds);
    state_ = std::move(state);
  }
  if (setpoint.motion) put(lcm_.setpoints_channel, setpoint.stamp, toMessage(setpoint));
}

void Recorder::tellLosses(Time now) {
  const auto dropped_now = dropped();
  for (std::size_t i = 0; i < kTapCount; ++i) tellLoss(now, toString(static_cast<Tap>(i)), dropped_now[i], told_[i]);
  if (log_.fault().empty()) tellLoss(now, "events of the log", log_.counters().events_lost, told_by_log_);
}

void Recorder::tellLoss(Time now, std::string_view what, std::uint64_t total, std::uint64_t& told) {
  if (total == told) return;
  lost_t lost{};
  lost.utime = utimeFromTime(now);
  lost.tap = what;
  lost.count = static_cast<std::int64_t>(total - told);
  lost.total = static_cast<std::int64_t>(total);
  if (put(lcm_.lost_channel, now, lost)) told = total;
}

std::array<std::uint64_t, kTapCount> Recorder::dropped() const {
  return {messages_.dropped(), ports_.steps.dropped(), ports_.decisions.dropped(), ports_.setpoints.dropped(),
          health_.dropped()};
}

template <class Message>
bool Recorder::put(const std::string& channel, Time log_stamp, const Message& message, Retention retention) {
  return encodeInto(message, encoded_) && log_.write(channel, log_stamp, encoded_, retention);
}

}  // namespace nanomap
