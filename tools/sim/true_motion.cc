#include "tools/sim/true_motion.h"

#include <algorithm>
#include <cstddef>

#include "drivers/mavlink/turn.h"

namespace nanomap::sim {
namespace {

/// Half a second of poses at 100 Hz: a moment of the past is asked for when the machine is late.
constexpr std::size_t kCapacity = 50;

/// Poses that are farther apart tell nothing about each other.
constexpr Duration kLongestGap = std::chrono::milliseconds(500);

/// Velocity changes over this time tell the acceleration: an estimator's noise of 1 cm/s is 0.2 m/s^2 then.
constexpr Duration kAccelerationBaseline = std::chrono::milliseconds(40);

simulation::VehicleState continued(const simulation::VehicleState& state, Duration ahead) {
  const double ahead_s = toSeconds(ahead);
  simulation::VehicleState later = state;
  later.T_W_B.translation_m += ahead_s * (state.velocity_W_m_s + ahead_s / 2.0 * state.acceleration_W_m_s2);
  later.T_W_B.rotation = turned(state.T_W_B.rotation, state.angular_rate_B_rad_s, ahead);
  later.velocity_W_m_s += ahead_s * state.acceleration_W_m_s2;
  return later;
}

}  // namespace

TrueMotion::TrueMotion(const NedFromWorld& T_NED_W) : T_NED_W_(T_NED_W), poses_(kCapacity) {}

void TrueMotion::add(const AutopilotPose& pose) {
  if (!poses_.empty() && pose.stamp <= newest()) return;
  Sample sample;
  sample.stamp = pose.stamp;
  // Both body frames have the same x axis; y and z are turned by half a turn about it.
  const Quat R_W_NED = T_NED_W_.pose().rotation.conjugate();
  const Quat R_FRD_FLU(0.0, 1.0, 0.0, 0.0);
  sample.state.T_W_B = {R_W_NED * pose.R_NED_FRD * R_FRD_FLU, T_NED_W_.pointInWorld(pose.position_NED_m)};
  sample.state.velocity_W_m_s = T_NED_W_.directionInWorld(pose.velocity_NED_m_s);
  sample.state.acceleration_W_m_s2 = meanAcceleration(pose.stamp, sample.state.velocity_W_m_s);
  sample.state.angular_rate_B_rad_s = flipped(pose.angular_rate_FRD_rad_s);

  if (!poses_.empty() && pose.stamp - newest() <= kLongestGap) {
    const Pose expected = at(pose.stamp).T_W_B;
    const double error_m = (expected.translation_m - sample.state.T_W_B.translation_m).norm();
    const double error_rad = expected.rotation.angularDistance(sample.state.T_W_B.rotation);
    ++error_.count;
    error_.square_sum_m2 += error_m * error_m;
    error_.worst_m = std::max(error_.worst_m, error_m);
    error_.square_sum_rad2 += error_rad * error_rad;
    error_.worst_rad = std::max(error_.worst_rad, error_rad);
  }
  if (poses_.full()) poses_.popFront();
  poses_.pushBack(sample);
}

Vec3 TrueMotion::meanAcceleration(Time stamp, const Vec3& velocity_W_m_s) const {
  for (std::size_t i = poses_.size(); i-- > 0;) {
    const Duration since = stamp - poses_[i].stamp;
    if (since > kLongestGap) break;
    if (since >= kAccelerationBaseline) {
      return (velocity_W_m_s - poses_[i].state.velocity_W_m_s) / toSeconds(since);
    }
  }
  return Vec3::Zero();
}

simulation::VehicleState TrueMotion::at(Time stamp) const {
  std::size_t i = poses_.size() - 1;
  while (i > 0 && poses_[i].stamp > stamp) --i;
  return continued(poses_[i].state, stamp - poses_[i].stamp);
}

}  // namespace nanomap::sim
