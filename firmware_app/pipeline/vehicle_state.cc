#include "firmware_app/pipeline/vehicle_state.h"

#include <chrono>
#include <limits>

namespace nanomap {
namespace {

/// Long enough that a millimetre of noise is a centimetre per second; the mean lags by half of it, which is 0.1 m/s at
/// 2 m/s^2.
constexpr Duration kBaseline = std::chrono::milliseconds(100);

/// No vehicle is pushed harder: between poses it is a step of the estimator, too small to be told from motion by its
/// speed alone (epoch_assigner.h).
constexpr double kHardest_m_s2 = 30.0;

Vec3 meanVelocity(const BodyPose& pose, const PoseBuffer& poses) {
  const Vec3 unknown = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  constexpr Duration kHalf = kBaseline / 2;
  const PoseBuffer::Lookup before = poses.interpolate(pose.stamp - kBaseline);
  const PoseBuffer::Lookup middle = poses.interpolate(pose.stamp - kHalf);
  const auto isKnown = [&](const PoseBuffer::Lookup& at) {
    return at.status == PoseBuffer::LookupStatus::kFound && at.epoch == pose.epoch;
  };
  if (!isKnown(before) || !isKnown(middle)) return unknown;
  const Vec3 early_m = middle.T_W_B.translation_m - before.T_W_B.translation_m;
  const Vec3 late_m = pose.T_W_B.translation_m - middle.T_W_B.translation_m;
  if ((late_m - early_m).norm() > kHardest_m_s2 * toSeconds(kHalf) * toSeconds(kHalf)) return unknown;
  return (early_m + late_m) / toSeconds(kBaseline);
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
