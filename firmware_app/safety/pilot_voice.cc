#include "firmware_app/safety/pilot_voice.h"

namespace nanomap {
namespace {

/// A pilot who connects late should not have to wait for longer to learn what is missing.
constexpr Duration kReminder = std::chrono::seconds(10);

/// What is missing while waiting flickers as streams start.
constexpr Duration kWaitingHurry = std::chrono::seconds(2);

/// A reason to hover that goes within that time is no news; nor is its end, if it is back within that time: a vehicle
/// that follows its goal as the estimate drifts does so by small hops.
constexpr Duration kReasonLasts = std::chrono::seconds(1);

bool isNews(Reason reason) {
  return reason != Reason::kFlying && reason != Reason::kKeeping && reason != Reason::kSlowing;
}

PilotText textOf(const SafetyVerdict& verdict) {
  switch (verdict.state) {
    case State::kWaiting:
      return {Severity::kWarning, "NanoMap waits for: " + verdict.faults.words()};
    case State::kReady:
      if (verdict.old_switch) return {Severity::kNotice, "NanoMap ready: leave OFFBOARD or GUIDED, and switch again"};
      return {Severity::kInfo, "NanoMap ready: switch to OFFBOARD or GUIDED"};
    case State::kFlying:
      return {Severity::kNotice, "NanoMap flies"};
    case State::kBraking:
      return {
          verdict.critical ? Severity::kCritical : Severity::kWarning,
          (verdict.critical ? "NanoMap stops, still without: " : "NanoMap brakes, without: ") + verdict.faults.words()};
    case State::kLost:
      break;
  }
  const std::string reason = verdict.faults.any() ? ". Without: " + verdict.faults.words() : "";
  return {Severity::kCritical, "NanoMap has let go: take over" + reason};
}

}  // namespace

std::optional<PilotText> PilotVoice::step(Time now, const SafetyVerdict& verdict, Reason reason) {
  if (auto text = ofState(now, verdict)) return text;
  return ofReason(now, verdict, reason);
}

std::optional<PilotText> PilotVoice::ofState(Time now, const SafetyVerdict& verdict) {
  const bool may_pass = verdict.state == State::kWaiting || verdict.state == State::kBraking;
  const bool settling = may_pass && !verdict.faults.any();
  if (settling) return std::nullopt;  // the next state will be said
  if (told_) {
    const bool same_state = told_->state == verdict.state;
    const bool waiting = verdict.state == State::kWaiting;
    const bool other_words = waiting && told_->faults != verdict.faults && now - told_at_ >= kWaitingHurry;
    const bool other_switch = told_->old_switch != verdict.old_switch;
    const bool worse = verdict.critical && !told_->critical;
    const bool due = waiting && now - told_at_ >= kReminder;
    if (same_state && !other_words && !other_switch && !worse && !due) return std::nullopt;
  }
  told_ = verdict;
  told_at_ = now;
  return textOf(verdict);
}

std::optional<PilotText> PilotVoice::ofReason(Time now, const SafetyVerdict& verdict, Reason reason) {
  const bool other = reason != reason_;
  if (other && !isNews(reason) && now - reason_seen_ < kReasonLasts) return std::nullopt;
  reason_seen_ = now;
  if (other) {
    reason_ = reason;
    reason_since_ = now;
    reason_told_ = false;
  }
  if (verdict.state != State::kFlying || reason_told_ || now - reason_since_ < kReasonLasts) return std::nullopt;
  reason_told_ = true;
  if (!isNews(reason)) return std::nullopt;
  return PilotText{Severity::kInfo, "NanoMap: " + std::string(toString(reason))};
}

}  // namespace nanomap
