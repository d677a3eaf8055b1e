#include "drivers/mavlink/odometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {
namespace {

VioOdometry odometry() {
  VioOdometry odometry;
  odometry.stamp = Time(std::chrono::seconds(7));
  odometry.T_W_B = {Quat(Eigen::AngleAxisd(1.2, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(0.4, Vec3::UnitY())),
                    Vec3(1.0, 2.0, 3.0)};
  odometry.velocity_W_m_s = odometry.T_W_B.rotation * Vec3(4.0, 5.0, 6.0);
  odometry.angular_rate_B_rad_s = Vec3(0.1, 0.2, 0.3);
  return odometry;
}

TEST(Odometry, IsTurnedUpsideDown) {
  const OdometryMessage message = toFrd(odometry());
  EXPECT_EQ(message.position_m, Vec3f(1.0F, -2.0F, -3.0F));
  EXPECT_LT((message.velocity_m_s - Vec3f(4.0F, -5.0F, -6.0F)).norm(), 1e-5F);  // in the body frame
  EXPECT_LT((message.angular_rate_rad_s - Vec3f(0.1F, -0.2F, -0.3F)).norm(), 1e-6F);
  // Nose and left wing, upside down, point where they did.
  const Quat R_W_B = odometry().T_W_B.rotation;
  const Quat R_FRD = message.rotation.cast<double>();
  EXPECT_LT((R_FRD * Vec3::UnitX() - flipped(Vec3(R_W_B * Vec3::UnitX()))).norm(), 1e-6);
  EXPECT_LT((R_FRD * -Vec3::UnitY() - flipped(Vec3(R_W_B * Vec3::UnitY()))).norm(), 1e-6);
}

TEST(Odometry, HasTheUpperTriangleWithFlippedSigns) {
  VioOdometry given = odometry();
  Mat6 covariance;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column)
      covariance(row, column) = 10.0 * std::min(row, column) + std::max(row, column);
  }
  given.pose_covariance_W = covariance;
  given.velocity_covariance_B = Mat6::Identity();
  const OdometryMessage message = toFrd(given);
  const OdometryMessage::Triangle expected{0,  -1,  -2,  3,  -4, -5,  //
                                           11, 12,  -13, 14, 15,      //
                                           22, -23, 24,  25,          //
                                           33, -34, -35,              //
                                           44, 45,                    //
                                           55};
  EXPECT_EQ(message.pose_covariance, expected);
  EXPECT_EQ(message.velocity_covariance[0], 1.0F);
  EXPECT_EQ(message.velocity_covariance[20], 1.0F);
}

TEST(Odometry, SaysWhatIsNotKnown) {
  VioOdometry given = odometry();
  given.velocity_W_m_s.reset();
  given.angular_rate_B_rad_s.reset();
  const OdometryMessage message = toFrd(given);
  EXPECT_TRUE(message.velocity_m_s.array().isNaN().all());
  EXPECT_TRUE(message.angular_rate_rad_s.array().isNaN().all());
  EXPECT_TRUE(std::isnan(message.pose_covariance[0]));
  EXPECT_EQ(message.pose_covariance[1], 0.0F);
  EXPECT_TRUE(std::isnan(message.velocity_covariance[0]));
}

TEST(Odometry, SpreadIsACovarianceOnceItIsKnown) {
  EXPECT_FALSE(poseCovariance({}));
  EXPECT_FALSE(poseCovariance({.position_sd_m = 0.1})) << "half of one";
  EXPECT_FALSE(velocityCovariance({.position_sd_m = 0.1, .attitude_sd_rad = 0.02}));
  VioOdometry given = odometry();
  const OdometrySpread spread{.position_sd_m = 0.1, .attitude_sd_rad = 0.02, .velocity_sd_m_s = 0.3};
  given.pose_covariance_W = poseCovariance(spread);
  given.velocity_covariance_B = velocityCovariance(spread);
  const OdometryMessage message = toFrd(given);
  for (const std::size_t x_y_z : {0U, 6U, 11U}) {
    EXPECT_FLOAT_EQ(message.pose_covariance[x_y_z], 0.01F);
    EXPECT_FLOAT_EQ(message.velocity_covariance[x_y_z], 0.09F);
  }
  for (const std::size_t roll_pitch_yaw : {15U, 18U, 20U}) {
    EXPECT_FLOAT_EQ(message.pose_covariance[roll_pitch_yaw], 0.0004F);
    EXPECT_TRUE(std::isnan(message.velocity_covariance[roll_pitch_yaw])) << "of rates that are not told";
  }
  EXPECT_EQ(message.pose_covariance[1], 0.0F);
}

TEST(Odometry, CountsResetsByEpochAndTellsFailure) {
  VioOdometry given = odometry();
  given.epoch = 258;
  EXPECT_EQ(toFrd(given).reset_counter, 2);
  EXPECT_EQ(toFrd(given).quality, 0);
  given.failed = true;
  EXPECT_EQ(toFrd(given).quality, -1);
}

}  // namespace
}  // namespace nanomap
