#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

enum class AutopilotKind : std::uint8_t { kUnknown, kPx4, kArduPilot, kOther };
[[nodiscard]] std::string_view toString(AutopilotKind kind);

enum class LandedState : std::uint8_t { kUnknown, kOnGround, kInAir, kTakingOff, kLanding };

/// One moment of the autopilot's own estimate, in its LOCAL_NED.
struct AutopilotPose {
  Time stamp{};  ///< on our timeline
  Vec3 position_NED_m = Vec3::Zero();
  double heading_rad = 0.0;  ///< clockwise from north
  Vec3 velocity_NED_m_s = Vec3::Zero();
  Quat R_NED_FRD = Quat::Identity();
  Vec3 angular_rate_FRD_rad_s = Vec3::Zero();
};

/// What is known of the autopilot at one moment.
struct AutopilotState {
  AutopilotKind kind = AutopilotKind::kUnknown;
  std::optional<Duration> heartbeat_age;  ///< empty: never heard
  std::optional<Duration> position_age;
  std::optional<Duration> attitude_age;
  bool linked = false;  ///< its heartbeat is fresh; what follows is its last word either way
  bool armed = false;
  bool simulated = false;         ///< it says that it flies no real vehicle (MAV_MODE_FLAG_HIL_ENABLED)
  bool external_control = false;  ///< the pilot's mode is PX4's OFFBOARD or ArduCopter's GUIDED
  std::uint32_t custom_mode = 0;
  /// Times that the mode was seen to turn to external control from another one, with no gap in the link. One that it
  /// had from the first does not count: nobody chose it under our eyes.
  std::uint64_t external_control_entries = 0;
  LandedState landed = LandedState::kUnknown;
};

}  // namespace nanomap
