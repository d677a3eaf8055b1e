#include "drivers/mavlink/odometry.h"

#include <limits>

#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {
namespace {

constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();

Vec3f floatsOf(const std::optional<Vec3>& v) { return v ? Vec3f(v->cast<float>()) : Vec3f::Constant(kNotKnown); }

/// Without correlations.
Mat6 covarianceOf(double first_sd, double second_sd) {
  Mat6 covariance = Mat6::Zero();
  covariance.diagonal().head<3>().setConstant(first_sd * first_sd);
  covariance.diagonal().tail<3>().setConstant(second_sd * second_sd);
  return covariance;
}

/// Half a turn about x turns the sign of y and z, and of the angles about them.
OdometryMessage::Triangle flippedTriangle(const std::optional<Mat6>& covariance) {
  OdometryMessage::Triangle triangle{};
  if (!covariance) {
    triangle.front() = kNotKnown;
    return triangle;
  }
  const Eigen::Vector<double, 6> signs{1.0, -1.0, -1.0, 1.0, -1.0, -1.0};
  std::size_t element = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      triangle[element++] = static_cast<float>(signs[row] * signs[column] * (*covariance)(row, column));
    }
  }
  return triangle;
}

}  // namespace

std::optional<Mat6> poseCovariance(const OdometrySpread& spread) {
  if (spread.position_sd_m <= 0.0 || spread.attitude_sd_rad <= 0.0) return std::nullopt;
  return covarianceOf(spread.position_sd_m, spread.attitude_sd_rad);
}

std::optional<Mat6> velocityCovariance(const OdometrySpread& spread) {
  if (spread.velocity_sd_m_s <= 0.0) return std::nullopt;
  return covarianceOf(spread.velocity_sd_m_s, std::numeric_limits<double>::quiet_NaN());
}

OdometryMessage toFrd(const VioOdometry& odometry) {
  constexpr std::uint32_t kLowestByte = 0xFF;
  OdometryMessage message;
  message.stamp = odometry.stamp;
  message.position_m = flipped(odometry.T_W_B.translation_m).cast<float>();
  message.rotation = flipped(odometry.T_W_B.rotation).cast<float>();
  std::optional<Vec3> velocity_FRD_m_s;
  if (odometry.velocity_W_m_s) {
    velocity_FRD_m_s = flipped(Vec3(odometry.T_W_B.rotation.conjugate() * *odometry.velocity_W_m_s));
  }
  message.velocity_m_s = floatsOf(velocity_FRD_m_s);
  std::optional<Vec3> rate_FRD_rad_s;
  if (odometry.angular_rate_B_rad_s) rate_FRD_rad_s = flipped(*odometry.angular_rate_B_rad_s);
  message.angular_rate_rad_s = floatsOf(rate_FRD_rad_s);
  message.pose_covariance = flippedTriangle(odometry.pose_covariance_W);
  message.velocity_covariance = flippedTriangle(odometry.velocity_covariance_B);
  message.reset_counter = static_cast<std::uint8_t>(odometry.epoch & kLowestByte);
  message.quality = odometry.failed ? -1 : 0;
  return message;
}

}  // namespace nanomap
