#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry.h"
#include "core/time.h"
#include "core/trajectory.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

/// Where to be and how to move there, at one moment, in W.
struct MotionSetpoint {
  Time stamp{};  ///< the moment; on its way out, a setpoint that has become too old is dropped
  Motion motion_W;
  std::optional<double> yaw_W_rad;  ///< empty: the autopilot keeps its heading
};

/// How to move only: for a vehicle that no longer knows where it is. Without the acceleration an autopilot would lag
/// behind, and stop a good way after the place that was verified.
struct VelocitySetpoint {
  Time stamp{};
  Vec3 velocity_W_m_s = Vec3::Zero();
  Vec3 acceleration_W_m_s2 = Vec3::Zero();
  std::optional<double> yaw_W_rad;
};

/// SET_POSITION_TARGET_LOCAL_NED in MAV_FRAME_LOCAL_NED, but for its addressee. What the mask tells to ignore is zero.
struct LocalNedTarget {
  std::uint32_t time_boot_ms = 0;
  std::uint16_t type_mask = 0;
  Vec3f position_NED_m = Vec3f::Zero();
  Vec3f velocity_NED_m_s = Vec3f::Zero();
  Vec3f acceleration_NED_m_s2 = Vec3f::Zero();
  float yaw_NED_rad = 0.0F;

  [[nodiscard]] bool isFinite() const;
  bool operator==(const LocalNedTarget&) const = default;
};

[[nodiscard]] LocalNedTarget toNed(const MotionSetpoint& setpoint, const NedFromWorld& T_NED_W);
[[nodiscard]] LocalNedTarget toNed(const VelocitySetpoint& setpoint, const NedFromWorld& T_NED_W);

/// `time` as MAVLink's 32-bit milliseconds, which wrap around after 49 days; and the age of such a stamp at `now`,
/// negative for one from the future.
[[nodiscard]] std::uint32_t bootMilliseconds(Time time);
[[nodiscard]] Duration ageOf(std::uint32_t time_boot_ms, Time now);

}  // namespace nanomap
