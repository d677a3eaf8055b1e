#include "drivers/mavlink/setpoint.h"

#include <cmath>

namespace nanomap {
namespace {

// POSITION_TARGET_TYPEMASK of the MAVLink common dialect: each bit tells to ignore something.
constexpr std::uint16_t kIgnorePosition = 0b111;
constexpr std::uint16_t kIgnoreYaw = 1 << 10;
constexpr std::uint16_t kIgnoreYawRate = 1 << 11;

LocalNedTarget targetAt(Time stamp, const Vec3& velocity_W_m_s, const Vec3& acceleration_W_m_s2,
                        const std::optional<double>& yaw_W_rad, const NedFromWorld& T_NED_W) {
  LocalNedTarget target;
  target.time_boot_ms = bootMilliseconds(stamp);
  target.type_mask = kIgnoreYawRate;
  target.velocity_NED_m_s = T_NED_W.direction(velocity_W_m_s).cast<float>();
  target.acceleration_NED_m_s2 = T_NED_W.direction(acceleration_W_m_s2).cast<float>();
  if (yaw_W_rad) {
    target.yaw_NED_rad = static_cast<float>(T_NED_W.heading(*yaw_W_rad));
  } else {
    target.type_mask |= kIgnoreYaw;
  }
  return target;
}

}  // namespace

bool LocalNedTarget::isFinite() const {
  return position_NED_m.allFinite() && velocity_NED_m_s.allFinite() && acceleration_NED_m_s2.allFinite() &&
         std::isfinite(yaw_NED_rad);
}

LocalNedTarget toNed(const MotionSetpoint& setpoint, const NedFromWorld& T_NED_W) {
  const Motion& motion_W = setpoint.motion_W;
  LocalNedTarget target =
      targetAt(setpoint.stamp, motion_W.velocity_m_s, motion_W.acceleration_m_s2, setpoint.yaw_W_rad, T_NED_W);
  target.position_NED_m = T_NED_W.point(motion_W.position_m).cast<float>();
  return target;
}

LocalNedTarget toNed(const VelocitySetpoint& setpoint, const NedFromWorld& T_NED_W) {
  LocalNedTarget target =
      targetAt(setpoint.stamp, setpoint.velocity_W_m_s, setpoint.acceleration_W_m_s2, setpoint.yaw_W_rad, T_NED_W);
  target.type_mask |= kIgnorePosition;
  return target;
}

std::uint32_t bootMilliseconds(Time time) {
  return static_cast<std::uint32_t>(std::chrono::floor<std::chrono::milliseconds>(time).time_since_epoch().count());
}

Duration ageOf(std::uint32_t time_boot_ms, Time now) {
  return std::chrono::milliseconds(static_cast<std::int32_t>(bootMilliseconds(now) - time_boot_ms));
}

}  // namespace nanomap
