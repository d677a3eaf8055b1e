#pragma once

#include <cstdint>
#include <string>

#include "core/geometry.h"

/// What this driver reads of the autopilot's messages, as they say it.
namespace nanomap {

struct HeartbeatMessage {
  std::uint8_t autopilot = 0;  ///< MAV_AUTOPILOT
  std::uint8_t base_mode = 0;  ///< MAV_MODE_FLAG
  std::uint32_t custom_mode = 0;
  std::uint8_t type = 0;  ///< MAV_TYPE
};

struct LocalPositionMessage {
  std::uint32_t time_boot_ms = 0;
  Vec3 position_NED_m = Vec3::Zero();
  Vec3 velocity_NED_m_s = Vec3::Zero();
};

struct AttitudeMessage {
  std::uint32_t time_boot_ms = 0;
  Quat R_NED_FRD = Quat::Identity();
  Vec3 angular_rate_FRD_rad_s = Vec3::Zero();
};

struct LandedStateMessage {
  std::uint8_t landed_state = 0;  ///< MAV_LANDED_STATE
};

struct ParameterMessage {
  std::string name;
  float value = 0.0F;     ///< parameter_value.h tells what it means
  std::uint8_t type = 0;  ///< MAV_PARAM_TYPE
};

}  // namespace nanomap
