#include "drivers/mavlink/autopilot_monitor.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "core/level_frame.h"
#include "drivers/mavlink/turn.h"

namespace nanomap {
namespace {

constexpr std::size_t kPoseCapacity = 64;  // more than a second of them at 50 Hz

AutopilotKind kindOf(std::uint8_t mav_autopilot) {
  constexpr std::uint8_t kArduPilotMega = 3;
  constexpr std::uint8_t kPx4 = 12;
  if (mav_autopilot == kPx4) return AutopilotKind::kPx4;
  return mav_autopilot == kArduPilotMega ? AutopilotKind::kArduPilot : AutopilotKind::kOther;
}

/// What ArduCopter flies, of MAV_TYPE: helicopters, and multicopters of three to twelve rotors.
bool isCopter(std::uint8_t mav_type) {
  constexpr std::uint8_t kCopters[] = {2, 3, 4, 13, 14, 15, 29, 35};
  return std::ranges::find(kCopters, mav_type) != std::end(kCopters);
}

/// The mode in which the autopilot obeys setpoints. ArduPilot numbers modes by vehicle: a rover's 4 is its HOLD.
bool isExternalControl(AutopilotKind kind, const HeartbeatMessage& heartbeat) {
  constexpr std::uint8_t kCustomModeEnabled = 1;
  constexpr std::uint32_t kPx4MainModeShift = 16;
  constexpr std::uint32_t kPx4MainModeMask = 0xFF;
  constexpr std::uint32_t kPx4Offboard = 6;
  constexpr std::uint32_t kCopterGuided = 4;
  if ((heartbeat.base_mode & kCustomModeEnabled) == 0) return false;
  const std::uint32_t mode = heartbeat.custom_mode;
  if (kind == AutopilotKind::kPx4) return ((mode >> kPx4MainModeShift) & kPx4MainModeMask) == kPx4Offboard;
  return kind == AutopilotKind::kArduPilot && isCopter(heartbeat.type) && mode == kCopterGuided;
}

LandedState landedStateOf(std::uint8_t mav_landed_state) {
  switch (mav_landed_state) {
    case 1:
      return LandedState::kOnGround;
    case 2:
      return LandedState::kInAir;
    case 3:
      return LandedState::kTakingOff;
    case 4:
      return LandedState::kLanding;
    default:
      return LandedState::kUnknown;
  }
}

std::optional<Duration> ageOf(const std::optional<Time>& arrival, Time now) {
  if (!arrival) return std::nullopt;
  return now - *arrival;
}

}  // namespace

std::string_view toString(AutopilotKind kind) {
  switch (kind) {
    case AutopilotKind::kUnknown:
      return "none";
    case AutopilotKind::kPx4:
      return "PX4";
    case AutopilotKind::kArduPilot:
      return "ArduPilot";
    case AutopilotKind::kOther:
      return "neither PX4 nor ArduPilot";
  }
  return "?";
}

AutopilotMonitor::AutopilotMonitor(Duration heartbeat_timeout)
    : heartbeat_timeout_(heartbeat_timeout), poses_(kPoseCapacity) {}

void AutopilotMonitor::receive(const HeartbeatMessage& message, Time arrival) {
  constexpr std::uint8_t kArmed = 128;
  constexpr std::uint8_t kHardwareInTheLoop = 32;
  const bool had_other_mode = state(arrival).linked && !last_.external_control;
  last_.kind = kindOf(message.autopilot);
  last_.armed = (message.base_mode & kArmed) != 0;
  last_.simulated = (message.base_mode & kHardwareInTheLoop) != 0;
  last_.custom_mode = message.custom_mode;
  last_.external_control = isExternalControl(last_.kind, message);
  if (had_other_mode && last_.external_control) ++last_.external_control_entries;
  heartbeat_arrival_ = arrival;
}

void AutopilotMonitor::receive(const LocalPositionMessage& message, Time arrival) {
  // The rate of a vehicle that turns may be another one by then.
  constexpr Duration kMaxApart = std::chrono::milliseconds(50);
  position_arrival_ = arrival;
  const Time stamp = clock_.toOurs(message.time_boot_ms, arrival);
  const Duration apart =
      attitude_ ? std::chrono::milliseconds(static_cast<std::int32_t>(message.time_boot_ms - attitude_->time_boot_ms))
                : Duration::max();
  if (apart > kMaxApart || apart < -kMaxApart) {
    ++counters_.poses_unmatched;
    return;
  }
  if (poses_.full()) {
    poses_.popFront();
    ++counters_.poses_dropped;
  }
  const Quat R_NED_FRD = turned(attitude_->R_NED_FRD, attitude_->angular_rate_FRD_rad_s, apart);
  // The forward axis, from north towards east: the same formula gives the heading that gives the yaw in W.
  poses_.pushBack({stamp, message.position_NED_m, yawOf(R_NED_FRD), message.velocity_NED_m_s, R_NED_FRD,
                   attitude_->angular_rate_FRD_rad_s});
  ++counters_.poses;
}

void AutopilotMonitor::receive(const AttitudeMessage& message, Time arrival) {
  attitude_arrival_ = arrival;
  clock_.toOurs(message.time_boot_ms, arrival);
  attitude_ = message;
}

void AutopilotMonitor::receive(const LandedStateMessage& message, Time /*arrival*/) {
  last_.landed = landedStateOf(message.landed_state);
}

AutopilotState AutopilotMonitor::state(Time now) const {
  AutopilotState state = last_;
  state.heartbeat_age = ageOf(heartbeat_arrival_, now);
  state.position_age = ageOf(position_arrival_, now);
  state.attitude_age = ageOf(attitude_arrival_, now);
  state.linked = state.heartbeat_age && *state.heartbeat_age < heartbeat_timeout_;
  return state;
}

std::optional<AutopilotPose> AutopilotMonitor::takePose() {
  if (poses_.empty()) return std::nullopt;
  const AutopilotPose pose = poses_.front();
  poses_.popFront();
  return pose;
}

}  // namespace nanomap
