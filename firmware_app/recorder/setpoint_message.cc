#include "firmware_app/recorder/setpoint_message.h"

#include <cassert>

#include "drivers/lcm/convert.h"

namespace nanomap {

setpoint_t toMessage(const SentSetpoint& setpoint) {
  assert(setpoint.motion);
  const CommandedMotion& motion = *setpoint.motion;
  setpoint_t message{};
  message.utime = utimeFromTime(setpoint.stamp);
  message.state = toString(setpoint.verdict.state);
  message.has_decision = motion.decision.has_value() ? 1 : 0;
  message.decision_sequence = static_cast<std::int64_t>(motion.decision.value_or(0));
  message.has_position = motion.with_position ? 1 : 0;
  if (motion.with_position) Vec3::Map(message.position) = motion.motion_W.position_m;
  Vec3::Map(message.acceleration) = motion.motion_W.acceleration_m_s2;
  Vec3::Map(message.velocity) = motion.motion_W.velocity_m_s;
  message.has_yaw = 1;
  message.yaw = motion.yaw_W_rad;
  return message;
}

std::string stateInWords(const SafetyVerdict& verdict) {
  std::string words(toString(verdict.state));
  if (verdict.faults.any()) words += ": " + verdict.faults.words();
  return words;
}

}  // namespace nanomap
