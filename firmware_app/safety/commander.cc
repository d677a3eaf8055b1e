#include "firmware_app/safety/commander.h"

#include "core/level_frame.h"
#include "firmware_app/safety/sound_motion.h"

namespace nanomap {
namespace {

const SafetyParameters& checked(const SafetyParameters& parameters) {
  check(parameters);
  return parameters;
}

SystemStatus statusOf(const SafetyVerdict& verdict) {
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

LocalNedTarget toNed(Time now, const CommandedMotion& commanded, const NedFromWorld& T_NED_W) {
  if (commanded.with_position) return toNed(MotionSetpoint{now, commanded.motion_W, commanded.yaw_W_rad}, T_NED_W);
  const Motion& motion_W = commanded.motion_W;
  return toNed(VelocitySetpoint{now, motion_W.velocity_m_s, motion_W.acceleration_m_s2, commanded.yaw_W_rad}, T_NED_W);
}

}  // namespace

Commander::Commander(const SafetyParameters& parameters, const MotionLimits& limits, double max_yaw_rate_rad_s,
                     const Feedforward& feedforward, AutopilotWorld autopilot_world)
    : machine_(checked(parameters)),
      limits_(limits),
      in_force_(autopilot_world),
      heading_(max_yaw_rate_rad_s),
      feedforward_(feedforward) {}

bool isRefused(const CommandInputs& inputs) {
  return inputs.recording && !(inputs.autopilot.linked && inputs.autopilot.simulated);
}

Command Commander::step(Time now, const CommandInputs& inputs) {
  Command command;
  in_force_.follow(inputs.alignment);
  command.plan_refused = inputs.plan.in_force && !isSound(*inputs.plan.in_force, limits_);
  command.verdict = machine_.step(situationAt(now, inputs, command.plan_refused));
  const bool braked = command.verdict.state == State::kBraking || command.verdict.state == State::kLost;
  if (!braked && !command.plan_refused) in_force_.adopt(inputs.plan.in_force, inputs.plan.sequence, inputs.alignment);
  command.status = statusOf(command.verdict);
  command.motion = motion(now, command.verdict.stream, inputs);
  if (command.motion) {
    const NedFromWorld& T_NED_W = command.motion->decision ? in_force_.anchor() : *inputs.alignment.T_NED_W;
    command.target = toNed(now, *command.motion, T_NED_W);
  }
  return command;
}

Situation Commander::situationAt(Time now, const CommandInputs& inputs, bool plan_refused) const {
  const VehicleReport& vehicle = inputs.vehicle;
  const Alignment& alignment = inputs.alignment;
  Situation situation;
  situation.now = now;
  situation.camera = vehicle.camera;
  situation.depth = vehicle.newest_view;
  situation.depth_stuck = vehicle.camera_stuck;
  situation.ending = inputs.ending;
  situation.stalled = inputs.stalled;
  if (vehicle.state) {
    situation.pose = vehicle.state->stamp;
    situation.speed_m_s = vehicle.state->velocity_W_m_s.norm();
    situation.anchored = alignment.verdict == AlignmentVerdict::kGood && alignment.epoch == vehicle.state->epoch;
  }
  const auto& plan = inputs.plan.in_force;
  const bool flyable = plan && !plan_refused;
  if (flyable && vehicle.state && plan->consumed.epoch == vehicle.state->epoch) situation.plan = plan->stamp;
  if (const auto& decision = in_force_.decision()) {
    situation.brake_end = decision->brake.start() + fromSeconds(decision->brake.duration_s());
    situation.motion_anchored =
        in_force_.anchorHolds(alignment, vehicle.state ? vehicle.state->epoch : alignment.epoch);
  }
  situation.unsent_since = inputs.unsent_since;
  situation.linked = inputs.autopilot.linked;
  situation.live_refused = inputs.autopilot.linked && isRefused(inputs);
  situation.armed = inputs.autopilot.armed;
  situation.external_control = inputs.autopilot.external_control;
  situation.external_control_entries = inputs.autopilot.external_control_entries;
  return situation;
}

std::optional<CommandedMotion> Commander::motion(Time now, Stream stream, const CommandInputs& inputs) {
  if (stream == Stream::kNone) return std::nullopt;
  if (stream == Stream::kHold) {
    const Pose& T_W_B = inputs.vehicle.state->T_W_B;
    const double yaw_W_rad = yawOf(T_W_B.rotation);
    beginHeading(now, *inputs.vehicle.state);
    return CommandedMotion{{T_W_B.translation_m, Vec3::Zero(), Vec3::Zero()}, yaw_W_rad, true, std::nullopt};
  }
  if (!in_force_.decision()) return std::nullopt;
  const Decision& decision = *in_force_.decision();
  const auto& state = inputs.vehicle.state;
  if (heading_epoch_ != decision.consumed.epoch && state && state->epoch == decision.consumed.epoch) {
    beginHeading(now, *state);
  }
  const double yaw_W_rad = heading_.follow(now, decision.yaw_W_rad);
  return CommandedMotion{feedforward_.sample(decision.brake, now), yaw_W_rad, stream == Stream::kMotion,
                         in_force_.sequence()};
}

void Commander::beginHeading(Time now, const VehicleState& state) {
  heading_.reset(now, yawOf(state.T_W_B.rotation));
  heading_epoch_ = state.epoch;
}

}  // namespace nanomap
