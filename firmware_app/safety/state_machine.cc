#include "firmware_app/safety/state_machine.h"

namespace nanomap {
namespace {

bool older(const std::optional<Time>& stamp, Duration limit, Time now) { return !stamp || now - *stamp > limit; }

}  // namespace

std::string_view toString(State state) {
  switch (state) {
    case State::kWaiting:
      return "waiting";
    case State::kReady:
      return "ready";
    case State::kFlying:
      return "flying";
    case State::kBraking:
      return "braking";
    case State::kLost:
      return "lost";
  }
  return "?";
}

std::string_view toString(Stream stream) {
  switch (stream) {
    case Stream::kNone:
      return "none";
    case Stream::kHold:
      return "hold";
    case Stream::kMotion:
      return "motion";
    case Stream::kVelocity:
      return "velocity";
  }
  return "?";
}

SafetyVerdict StateMachine::step(const Situation& situation) {
  faults_ = faultsOf(situation);
  if (faults_.any()) last_fault_ = situation.now;
  last_step_ = situation.now;
  follow(situation);
  entries_seen_ = situation.external_control_entries;
  const bool critical = fault_since_ && situation.now - *fault_since_ >= parameters_.critical_after;
  const bool old_switch = state_ == State::kReady && situation.external_control && !ordered_;
  return {state_, stream(situation), faults_, critical || state_ == State::kLost, old_switch};
}

FaultSet StateMachine::faultsOf(const Situation& situation) const {
  const Time now = situation.now;
  FaultSet faults;
  if (situation.ending) faults.add(Fault::kEnding);
  if (last_step_ && now - *last_step_ > parameters_.max_step) faults.add(Fault::kHeldUp);
  if (situation.stalled) faults.add(Fault::kStalled);
  if (!situation.camera) faults.add(Fault::kCamera);
  if (older(situation.depth, parameters_.max_depth_age, now)) faults.add(Fault::kDepth);
  if (situation.depth_stuck) faults.add(Fault::kDepthStuck);
  if (older(situation.pose, parameters_.max_pose_age, now)) faults.add(Fault::kPose);
  const Time latest = now + parameters_.max_stamp_lead;
  if ((situation.depth && *situation.depth > latest) || (situation.pose && *situation.pose > latest)) {
    faults.add(Fault::kClock);
  }
  if (older(situation.plan, parameters_.max_plan_age, now)) faults.add(Fault::kPlan);
  if (situation.unsent_since && now - *situation.unsent_since > parameters_.max_step) faults.add(Fault::kUnsent);
  if (!situation.linked) faults.add(Fault::kAutopilot);
  if (!situation.anchored) faults.add(Fault::kAlignment);
  if (situation.live_refused) faults.add(Fault::kLive);
  return faults;
}

bool StateMachine::hasStopped(const Situation& situation) const {
  if (!situation.brake_end || situation.now >= *situation.brake_end + parameters_.stop_margin) return true;
  const bool stands =
      !faults_.has(Fault::kPose) && situation.speed_m_s && *situation.speed_m_s < parameters_.standstill_m_s;
  return stands && situation.now >= *situation.brake_end && situation.now - *fault_since_ >= parameters_.patience;
}

void StateMachine::follow(const Situation& situation) {
  const Time now = situation.now;
  const bool settled = !faults_.any() && (!last_fault_ || now - *last_fault_ >= parameters_.settle);
  const bool ours = situation.external_control && situation.armed;

  if (!situation.external_control) ordered_ = false;
  const bool in_our_hands = state_ == State::kFlying || state_ == State::kBraking || state_ == State::kLost;
  // The pilot may have taken over and given back meanwhile.
  if (in_our_hands && faults_.has(Fault::kAutopilot)) ordered_ = false;
  const bool taken = !ours && situation.linked;
  const bool order_is_old = state_ == State::kBraking && settled && !ordered_;
  if (in_our_hands && (taken || order_is_old)) {
    state_ = State::kWaiting;
    ordered_ = false;
    fault_since_.reset();
  }
  switch (state_) {
    case State::kWaiting:
      ordered_ = false;
      if (settled) state_ = State::kReady;
      break;
    case State::kReady:
      if (faults_.any()) {
        state_ = State::kWaiting;
        ordered_ = false;
        break;
      }
      if (situation.external_control && situation.external_control_entries > entries_seen_) ordered_ = true;
      if (ordered_ && ours) state_ = State::kFlying;
      break;
    case State::kFlying:
      if (!faults_.any()) break;
      fault_since_ = now;
      state_ = hasStopped(situation) ? State::kLost : State::kBraking;
      break;
    case State::kBraking:
      if (settled) {
        state_ = State::kFlying;
        fault_since_.reset();
      } else if (hasStopped(situation)) {
        state_ = State::kLost;
      }
      break;
    case State::kLost:
      break;
  }
}

Stream StateMachine::stream(const Situation& situation) const {
  switch (state_) {
    case State::kReady:
      return Stream::kHold;
    case State::kFlying:
      return Stream::kMotion;
    case State::kBraking:
      break;
    case State::kWaiting:
    case State::kLost:
      return Stream::kNone;
  }
  return situation.motion_anchored && !faults_.has(Fault::kPose) ? Stream::kMotion : Stream::kVelocity;
}

}  // namespace nanomap
