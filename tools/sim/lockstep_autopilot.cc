#include "tools/sim/lockstep_autopilot.h"

#include <cmath>

#include "core/level_frame.h"

namespace nanomap::sim {
namespace {

/// PX4's position control runs at this rate, and so does its telemetry here.
constexpr Duration kControlPeriod = std::chrono::milliseconds(10);

constexpr Duration kStreamTimeout = std::chrono::seconds(1);

/// HOLD brakes first: slower than that, it keeps the place.
constexpr double kStands_m_s = 0.3;

/// The scene's world in the autopilot's LOCAL_NED: anywhere, so that nothing is right by chance.
const NedFromWorld& T_NED_W() {
  static const NedFromWorld T_NED_W(1.2, {40.0, -20.0, -3.0});
  return T_NED_W;
}

}  // namespace

LockstepAutopilot::LockstepAutopilot(const simulation::MulticopterParameters& vehicle, const Vec3& position_W_m,
                                     double yaw_W_rad, Time start)
    : vehicle_(vehicle, position_W_m, yaw_W_rad),
      controller_({}),
      command_{Vec3::Zero(), yaw_W_rad},
      next_control_(start),
      hold_W_m_(position_W_m) {
  now = start;
  state.kind = AutopilotKind::kPx4;
  state.linked = true;
  state.armed = true;
  state.simulated = true;
  state.landed = LandedState::kInAir;
}

void LockstepAutopilot::advance(Time until) {
  for (; next_control_ <= until; next_control_ += kControlPeriod) {
    moveTo(next_control_);
    control();
    tellPose();
  }
  moveTo(until);
}

void LockstepAutopilot::moveTo(Time time) {
  if (time > now) vehicle_.advance(command_, time - now);
  now = time;
}

void LockstepAutopilot::control() {
  if (state.external_control && (!target || now - target->at > kStreamTimeout)) {
    state.external_control = false;
    ++failsafes_;
  }
  const simulation::VehicleState truth = vehicle_.state();
  const Motion own_W{truth.T_W_B.translation_m, truth.velocity_W_m_s, truth.acceleration_W_m_s2};
  command_.acceleration_W_m_s2 = controller_.acceleration(setpoint(own_W), own_W, kControlPeriod);
  if (state.external_control) {
    command_.yaw_W_rad = T_NED_W().heading(static_cast<double>(target->target.yaw_NED_rad));
  }
}

Motion LockstepAutopilot::setpoint(const Motion& own_W) {
  if (state.external_control) {
    hold_W_m_.reset();
    const LocalNedTarget& told = target->target;
    Motion motion_W{own_W.position_m, T_NED_W().directionInWorld(told.velocity_NED_m_s.cast<double>()),
                    T_NED_W().directionInWorld(told.acceleration_NED_m_s2.cast<double>())};
    if (target->withPosition()) motion_W.position_m = T_NED_W().pointInWorld(told.position_NED_m.cast<double>());
    return motion_W;
  }
  if (!hold_W_m_ && own_W.velocity_m_s.norm() < kStands_m_s) hold_W_m_ = own_W.position_m;
  return {hold_W_m_.value_or(own_W.position_m), Vec3::Zero(), Vec3::Zero()};
}

void LockstepAutopilot::tellPose() {
  const simulation::VehicleState truth = vehicle_.state();
  AutopilotPose pose;
  pose.stamp = now;
  pose.position_NED_m = T_NED_W().point(truth.T_W_B.translation_m);
  pose.heading_rad = T_NED_W().heading(yawOf(truth.T_W_B.rotation));
  pose.velocity_NED_m_s = T_NED_W().direction(truth.velocity_W_m_s);
  poses.push_back(pose);
}

}  // namespace nanomap::sim
