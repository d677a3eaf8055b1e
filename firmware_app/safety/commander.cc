#include "firmware_app/safety/commander.h"

#include "core/level_frame.h"

namespace nanomap {
namespace {

const SafetyParameters& checked(const SafetyParameters& parameters) {
  check(parameters);
  return parameters;
}

SystemStatus statusOf(const Verdict& verdict) {
  switch (verdict.state) {
    case State::kReady:
      return SystemStatus::kStandby;
    case State::kFlying:
      return SystemStatus::kActive;
    case State::kBraking:
      return SystemStatus::kCritical;
    case State::kLost:
      return SystemStatus::kEmergency;
    case State::kWaiting:
      break;
  }
  return SystemStatus::kBoot;
}

}  // namespace

Commander::Commander(const SafetyParameters& parameters, double max_yaw_rate_rad_s)
    : machine_(checked(parameters)), heading_(max_yaw_rate_rad_s) {}

Command Commander::step(Time now, const CommandInputs& inputs) {
  motion_.update(inputs.plan.in_force, inputs.alignment);
  const Verdict verdict = machine_.step(situationAt(now, inputs));
  return {verdict, target(now, verdict.stream, inputs), statusOf(verdict)};
}

Situation Commander::situationAt(Time now, const CommandInputs& inputs) const {
  const VehicleReport& vehicle = inputs.vehicle;
  const Alignment& alignment = inputs.alignment;
  Situation situation;
  situation.now = now;
  situation.camera = vehicle.camera;
  situation.depth = vehicle.newest_view;
  situation.stalled = inputs.stalled;
  if (vehicle.state) {
    situation.pose = vehicle.state->stamp;
    situation.speed_m_s = vehicle.state->velocity_W_m_s.norm();
    situation.anchored = alignment.verdict == AlignmentVerdict::kGood && alignment.epoch == vehicle.state->epoch;
  }
  if (const auto& decision = motion_.decision()) {
    situation.plan = decision->stamp;
    situation.brake_end = decision->brake.start() + fromSeconds(decision->brake.duration_s());
    situation.anchored_before_jump = decision->consumed.epoch != alignment.epoch;
  }
  situation.linked = inputs.autopilot.linked;
  situation.armed = inputs.autopilot.armed;
  situation.external_control = inputs.autopilot.external_control;
  situation.external_control_entries = inputs.autopilot.external_control_entries;
  return situation;
}

std::optional<LocalNedTarget> Commander::target(Time now, Stream stream, const CommandInputs& inputs) {
  if (stream == Stream::kNone) return std::nullopt;
  if (stream == Stream::kHold) {
    const VehicleState& state = *inputs.vehicle.state;
    const double yaw_W_rad = yawOf(state.T_W_B.rotation);
    heading_.reset(now, yaw_W_rad);
    const Motion standing{state.T_W_B.translation_m, Vec3::Zero(), Vec3::Zero()};
    return toNed(MotionSetpoint{now, standing, yaw_W_rad}, *inputs.alignment.T_NED_W);
  }
  const Decision& decision = *motion_.decision();
  const Motion motion = decision.brake.sample(now);
  const double yaw_W_rad = heading_.follow(now, decision.yaw_W_rad);
  if (stream == Stream::kVelocity) {
    return toNed(VelocitySetpoint{now, motion.velocity_m_s, yaw_W_rad}, motion_.anchor());
  }
  return toNed(MotionSetpoint{now, motion, yaw_W_rad}, motion_.anchor());
}

}  // namespace nanomap
