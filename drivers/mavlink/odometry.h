#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// Position or velocity [m, m/s] first, then roll, pitch and yaw or their rates [rad, rad/s].
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// How wrong poses are that say nothing of it themselves: standard deviations, on each axis. 0: nobody knows.
struct OdometrySpread {
  double position_sd_m = 0.0;
  double attitude_sd_rad = 0.0;
  double velocity_sd_m_s = 0.0;
};

/// Of position and attitude; empty unless both are known.
[[nodiscard]] std::optional<Mat6> poseCovariance(const OdometrySpread& spread);

/// Of the velocity, with NaN for the rates, of which nothing is known; empty if it is not known either.
[[nodiscard]] std::optional<Mat6> velocityCovariance(const OdometrySpread& spread);

/// What the VIO says about the vehicle at one moment. Absolute (marginal) covariances: they are passed on, never
/// summed.
struct VioOdometry {
  Time stamp{};
  std::uint32_t epoch = 0;
  Pose T_W_B;
  std::optional<Vec3> velocity_W_m_s;
  std::optional<Vec3> angular_rate_B_rad_s;
  std::optional<Mat6> pose_covariance_W;
  std::optional<Mat6> velocity_covariance_B;
  bool failed = false;  ///< the estimator says that it is lost
};

/// ODOMETRY: pose in MAV_FRAME_LOCAL_FRD (W, turned upside down: no heading or origin but the VIO's own), velocities in
/// MAV_FRAME_BODY_FRD. NaN is "not known"; a covariance that is not known has NaN in front.
struct OdometryMessage {
  static constexpr std::size_t kTriangle = 21;  ///< elements of the upper right triangle of a 6x6 matrix
  using Triangle = std::array<float, kTriangle>;

  Time stamp{};
  Vec3f position_m = Vec3f::Zero();
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  Vec3f velocity_m_s = Vec3f::Zero();
  Vec3f angular_rate_rad_s = Vec3f::Zero();
  Triangle pose_covariance{};
  Triangle velocity_covariance{};
  std::uint8_t reset_counter = 0;  ///< the epoch's lowest byte: another value than before says that the world jumped
  std::int8_t quality = 0;         ///< -1 failed, 0 not known
};

[[nodiscard]] OdometryMessage toFrd(const VioOdometry& odometry);

}  // namespace nanomap
