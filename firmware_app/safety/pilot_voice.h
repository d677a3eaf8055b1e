#pragma once

#include <optional>
#include <string>

#include "core/decision.h"
#include "core/time.h"
#include "drivers/mavlink/status_text.h"
#include "firmware_app/safety/state_machine.h"

namespace nanomap {

/// One thing said to the pilot.
struct PilotText {
  Severity severity = Severity::kInfo;
  std::string text;

  bool operator==(const PilotText&) const = default;
};

/// What is said to the pilot, and when: each change of state, a fault that has become critical, a new reason to hover
/// once it has lasted, and what is missing again from time to time. Never more than one text a step, nor the same one
/// in a hurry. Threads: one. Allocates.
class PilotVoice {
 public:
  [[nodiscard]] std::optional<PilotText> step(Time now, const SafetyVerdict& verdict, Reason reason);

 private:
  [[nodiscard]] std::optional<PilotText> ofState(Time now, const SafetyVerdict& verdict);
  [[nodiscard]] std::optional<PilotText> ofReason(Time now, const SafetyVerdict& verdict, Reason reason);

  std::optional<SafetyVerdict> told_;  ///< as last told
  Time told_at_{};
  Reason reason_ = Reason::kFlying;
  Time reason_since_{};
  Time reason_seen_{};
  bool reason_told_ = true;
};

}  // namespace nanomap
