#include "firmware_app/pipeline/vehicle_state.h"

#include <chrono>
#include <limits>

namespace nanomap {
namespace {

/// Long enough that a millimetre of noise is a centimetre per second; the mean lags by half of it, which is 0.1 m/s at
/// 2 m/s^2.
constexpr Duration kBaseline = std::chrono::milliseconds(100);

Vec3 meanVelocity(const BodyPose& pose, const PoseBuffer& poses) {
  const PoseBuffer::Lookup before = poses.interpolate(pose.stamp - kBaseline);
  if (before.status != PoseBuffer::LookupStatus::kFound || before.epoch != pose.epoch) {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return (pose.T_W_B.translation_m - before.T_W_B.translation_m) / toSeconds(kBaseline);
}

}  // namespace

VehicleState vehicleStateAt(const BodyPose& pose, const std::optional<BodyMotion>& motion, const PoseBuffer& poses) {
  VehicleState state;
  state.stamp = pose.stamp;
  state.epoch = pose.epoch;
  state.sequence = pose.sequence;
  state.T_W_B = pose.T_W_B;
  state.velocity_W_m_s = motion ? motion->velocity_W_m_s : meanVelocity(pose, poses);
  if (motion) state.acceleration_W_m_s2 = motion->acceleration_W_m_s2;
  return state;
}

}  // namespace nanomap
