#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/time.h"
#include "drivers/lcm/convert.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap::test {

/// A path of its own for each test.
inline std::filesystem::path testFile(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string unique = std::string(test->test_suite_name()) + "." + test->name() + "." + name;
  std::replace(unique.begin(), unique.end(), '/', '.');  // of tests with parameters
  return std::filesystem::path(::testing::TempDir()) / unique;
}

inline Time atMs(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

/// Writes the log of a small flight, message by message: a vehicle that flies along x towards a wall 8 m from the
/// origin, at 1 m/s. Each message is logged at its own stamp unless told otherwise.
class FlightLog {
 public:
  static constexpr double kWall_m = 8.0;
  static constexpr double kSpeed_m_s = 1.0;

  explicit FlightLog(std::filesystem::path path) : path_(std::move(path)), writer_(path_) {}

  void camera(std::int64_t ms, const CameraParameters& parameters = smallCamera(), const std::string& name = "front") {
    writer_.write(lcm_.camera_channel, atMs(ms), toMessage(parameters, name, atMs(ms)));
  }

  /// @param change  makes the pose another one than the flight's
  void pose(std::int64_t ms, const std::function<void(BodyPose&)>& change = {}) {
    BodyPose pose = flightPose(ms);
    if (change) change(pose);
    writer_.write(lcm_.pose_channel, atMs(ms), toMessage(pose, std::nullopt));
  }

  /// The same as bot_core.pose_t, `offset_m` aside along y.
  void plainPose(std::int64_t ms, double offset_m = 0.0) {
    BodyPose pose = flightPose(ms);
    pose.T_W_B.translation_m.y() += offset_m;
    writer_.write(lcm_.pose_channel, atMs(ms), toPoseMessage(pose, BodyConvention::kFlu));
  }

  /// @param change  makes the image another one than the flight's
  void depth(std::int64_t ms, const std::function<void(DepthImage&)>& change = {}) {
    DepthImage image = flightImage(ms);
    if (change) change(image);
    writer_.write(lcm_.depth_channel, atMs(ms), toMessage(image, "front", DepthCompression::kBlosc));
  }

  /// @param change  makes the goal another one than 5 m ahead of the origin
  void goal(std::int64_t ms, const std::function<void(goal_t&)>& change = {}) {
    goal_t goal{};
    goal.utime = utimeFromTime(atMs(ms));
    goal.position[0] = 5.0;
    goal.top_speed = 2.0;
    if (change) change(goal);
    writer_.write(lcm_.goal_channel, atMs(ms), goal);
  }

  void correction(std::int64_t ms, const Correction& correction) {
    writer_.write(lcm_.correction_channel, atMs(ms), toMessage(correction, atMs(ms)));
  }

  /// Poses each 10 ms and depth each 100 ms, from `from_ms` to `to_ms`, ends included.
  void fly(std::int64_t from_ms, std::int64_t to_ms) {
    for (std::int64_t ms = from_ms; ms <= to_ms; ms += 10) {
      pose(ms);
      if (ms % 100 == 0) depth(ms);
    }
  }

  LogWriter& writer() { return writer_; }

  /// Ends the log.
  std::filesystem::path close() {
    writer_.close();
    return path_;
  }

  static BodyPose flightPose(std::int64_t ms) {
    BodyPose pose;
    pose.stamp = atMs(ms);
    pose.T_W_B.translation_m = {kSpeed_m_s * static_cast<double>(ms) * 1e-3, 0.0, 0.0};
    pose.sequence = static_cast<std::uint64_t>(ms);
    return pose;
  }

  static DepthImage flightImage(std::int64_t ms) {
    const double distance_m = kWall_m - flightPose(ms).T_W_B.translation_m.x();
    DepthImage image = flatImage(CameraModel(smallCamera()), static_cast<std::uint16_t>(1000.0 * distance_m), atMs(ms));
    image.sequence = static_cast<std::uint64_t>(ms);
    return image;
  }

 private:
  LcmParameters lcm_;
  std::filesystem::path path_;
  LogWriter writer_;
};

}  // namespace nanomap::test
