#include "firmware_app/pipeline/step.h"

#include <variant>

#include "drivers/lcm/convert.h"

namespace nanomap {

static_assert(step_t::POSE == static_cast<std::int8_t>(InputKind::kPose));
static_assert(step_t::CORRECTION == static_cast<std::int8_t>(InputKind::kCorrection));
static_assert(step_t::CAMERA == static_cast<std::int8_t>(InputKind::kCamera));
static_assert(step_t::DEPTH == static_cast<std::int8_t>(InputKind::kDepth));
static_assert(step_t::GOAL == static_cast<std::int8_t>(InputKind::kGoal));

step_t toMessage(const Step& step) {
  step_t message{};
  message.utime = utimeFromTime(step.taken);
  message.number = static_cast<std::int64_t>(step.number);
  message.kind = static_cast<std::int8_t>(step.kind);
  message.arrival_utime = utimeFromTime(step.arrival);
  message.stamp_shift = step.stamp_shift.count();
  return message;
}

std::optional<Step> toStep(const step_t& message) {
  const Converted<Time> taken = timeFromUtime(message.utime);
  const Converted<Time> arrival = timeFromUtime(message.arrival_utime);
  const bool has_kind = message.kind >= 0 && message.kind < static_cast<std::int8_t>(kInputKindCount);
  if (!std::holds_alternative<Time>(taken) || !std::holds_alternative<Time>(arrival) || message.number < 1 ||
      !has_kind) {
    return std::nullopt;
  }
  return Step{.taken = std::get<Time>(taken),
              .number = static_cast<std::uint64_t>(message.number),
              .kind = static_cast<InputKind>(message.kind),
              .arrival = std::get<Time>(arrival),
              .stamp_shift = Duration(message.stamp_shift)};
}

}  // namespace nanomap
