#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "core/level_frame.h"
#include "core/pose_buffer.h"
#include "drivers/mavlink/alignment_fit.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap::test {

inline constexpr double kHeading_rad = 70.0 * std::numbers::pi / 180.0;

/// Where W lies for the autopilot in these tests: 70 degrees of heading and an offset.
inline NedFromWorld trueAlignment() { return {kHeading_rad, Vec3(100.0, -20.0, 3.0)}; }

/// A vehicle that flies a circle of 5 m, or hovers, banked, as both estimators see it.
class TwoEstimators {
 public:
  explicit TwoEstimators(double speed_m_s = 2.0) : speed_m_s_(speed_m_s) {}

  NedFromWorld T_NED_W = trueAlignment();
  double position_noise_m = 0.0;
  double heading_noise_rad = 0.0;
  double compass_error_rad = 0.0;
  Pose T_Wgiven_W;  ///< an error of the VIO
  std::uint32_t epoch = 0;

  [[nodiscard]] BodyPose world(Time stamp) {
    const double angle_rad = angle(stamp);
    const Quat R_W_B = Eigen::AngleAxisd(angle_rad + std::numbers::pi / 2.0, Vec3::UnitZ()) *
                       Eigen::AngleAxisd(0.3, Vec3::UnitY()) * Eigen::AngleAxisd(-0.2, Vec3::UnitX());
    BodyPose pose;
    pose.stamp = stamp;
    pose.T_W_B = T_Wgiven_W * Pose{R_W_B, position(stamp)};
    pose.epoch = epoch;
    return pose;
  }

  [[nodiscard]] AutopilotPose autopilot(Time stamp) {
    return {stamp, T_NED_W.point(position(stamp)) + position_noise_m * Vec3(normal(), normal(), normal()),
            wrapAngle(T_NED_W.heading(angle(stamp) + std::numbers::pi / 2.0) + compass_error_rad +
                      heading_noise_rad * normal())};
  }

  [[nodiscard]] AlignmentPair pair(Time stamp) {
    const BodyPose in_W = world(stamp);
    const AutopilotPose in_NED = autopilot(stamp);
    return {stamp, in_W.T_W_B.translation_m, yawOf(in_W.T_W_B.rotation), in_NED.position_NED_m, in_NED.heading_rad};
  }

 private:
  static constexpr double kRadius_m = 5.0;

  [[nodiscard]] double angle(Time stamp) const { return speed_m_s_ / kRadius_m * toSeconds(stamp.time_since_epoch()); }
  [[nodiscard]] Vec3 position(Time stamp) const {
    const double angle_rad = angle(stamp);
    return {kRadius_m * std::cos(angle_rad), kRadius_m * std::sin(angle_rad), 2.0 + std::sin(angle_rad)};
  }
  [[nodiscard]] double normal() { return normal_(random_); }

  double speed_m_s_;
  std::mt19937 random_{17};
  std::normal_distribution<double> normal_;
};

}  // namespace nanomap::test
