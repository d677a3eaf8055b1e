#include "tools/import/recording_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <variant>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "png_files.h"
#include "tests/support/temporary_folder.h"
#include "tools/import/camera_preset.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Time at(std::int64_t ms) { return timeFromNanoseconds(ms * 1'000'000); }

class RecordingExportTest : public testing::Test {
 protected:
  RecordingExportTest() : camera_(cameraPresets().front().camera) {
    camera_.width_px = 3;
    camera_.height_px = 2;
  }

  void image(std::int64_t ms, const std::vector<std::uint16_t>& pixels = {1000, 0, 65535, 2000, 1, 2}) {
    const std::string name = std::to_string(recording_.images.size()) + ".png";
    recording_.images.push_back({at(ms), recording_.images.size(), folder_.write(name, encodeDepthPng(pixels, 3, 2))});
  }
  void pose(std::int64_t ms, const Vec3& position_W, double yaw_rad = 0.0) {
    const Quat R_W_B(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()));
    recording_.poses.push_back({at(ms), Pose{R_W_B, position_W} * camera_.T_B_C});
  }
  ExportCounts write() {
    LogWriter log(log_);
    const ExportCounts counts = writeRecording(recording_, camera_, LcmParameters(), log);
    log.close();
    return counts;
  }
  std::vector<std::string> channelsInOrder() {
    LogReader reader(log_);
    std::vector<std::string> channels;
    for (const LogEvent& event : reader.events()) channels.push_back(reader.channelOf(event));
    return channels;
  }
  template <class Message>
  std::vector<Message> messages() {
    LogReader reader(log_);
    std::vector<Message> found;
    std::vector<std::uint8_t> bytes;
    for (const LogEvent& event : reader.events()) {
      reader.read(event, bytes);
      if (messageHash(bytes) == Message::getHash()) found.push_back(std::get<Message>(decode<Message>(bytes)));
    }
    return found;
  }

  TemporaryFolder folder_;
  std::filesystem::path log_ = folder_.path() / "out.log";
  CameraParameters camera_;
  Recording recording_;
};

TEST_F(RecordingExportTest, BringsCameraFirstAndPoseBeforeItsImage) {
  image(0);
  image(33);
  for (const std::int64_t ms : {0, 33}) pose(ms, Vec3::Zero());
  const ExportCounts counts = write();
  EXPECT_EQ(counts.images, 2U);
  EXPECT_EQ(counts.poses, 2U);
  EXPECT_EQ(counts.images_without_pose, 0U);
  EXPECT_THAT(channelsInOrder(), ElementsAre("CAMERA", "POSE_BODY", "DEPTH", "POSE_BODY", "DEPTH"));
}

TEST_F(RecordingExportTest, WritesImageAsMeasured) {
  image(33);
  pose(33, Vec3::Zero());
  write();
  const auto converted = toDepthImage(messages<depth_image_t>().at(0));
  const auto& depth = std::get<DepthImage>(converted);
  EXPECT_EQ(depth.stamp, at(33));
  EXPECT_EQ(depth.width_px, 3);
  EXPECT_EQ(depth.depth_unit_m, camera_.depth_unit_m);
  EXPECT_THAT(depth.pixels, ElementsAre(1000, 0, 65535, 2000, 1, 2));
}

TEST_F(RecordingExportTest, TurnsCameraPosesIntoBodyPoses) {
  image(0);
  pose(0, {1.0, -2.0, 0.5}, 0.3);
  write();
  const auto converted = toBodyPose(messages<body_pose_t>().at(0));
  const Pose& T_W_B = std::get<BodyPose>(converted).T_W_B;
  EXPECT_LT((T_W_B.translation_m - Vec3(1.0, -2.0, 0.5)).norm(), 1e-12);
  EXPECT_LT(T_W_B.rotation.angularDistance(Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()))), 1e-7);
}

TEST_F(RecordingExportTest, DifferencesGiveVelocities) {
  image(0);
  for (const std::int64_t i : {0, 1, 2})
    pose(100 * i, {0.2 * static_cast<double>(i), 0.0, 0.0}, 0.05 * static_cast<double>(i));
  write();
  for (const body_pose_t& pose : messages<body_pose_t>()) {
    EXPECT_NEAR(pose.velocity[0], 2.0, 1e-9);
    EXPECT_NEAR(pose.velocity[1], 0.0, 1e-9);
    EXPECT_NEAR(pose.angular_rate[2], 0.5, 1e-9);
    EXPECT_TRUE(std::isnan(pose.acceleration[0]));
  }
}

TEST_F(RecordingExportTest, LeavesVelocityOfLonePoseUnknown) {
  image(0);
  pose(0, Vec3::Zero());
  write();
  EXPECT_TRUE(std::isnan(messages<body_pose_t>().at(0).velocity[0]));
}

TEST_F(RecordingExportTest, CountsImagesOutsideThePoses) {
  for (const std::int64_t ms : {0, 100, 200}) image(ms);
  for (const std::int64_t ms : {50, 150}) pose(ms, Vec3::Zero());
  const ExportCounts counts = write();
  EXPECT_EQ(counts.images, 3U);
  EXPECT_EQ(counts.images_without_pose, 2U);
}

TEST_F(RecordingExportTest, CrossesSecondBoundaryInOrder) {
  for (const std::int64_t ms : {966, 1000, 1033}) {
    image(ms);
    pose(ms, Vec3::Zero());
  }
  write();
  LogReader reader(log_);
  EXPECT_TRUE(std::ranges::is_sorted(reader.events(), {}, &LogEvent::log_stamp));
  EXPECT_EQ(messages<depth_image_t>().at(1).utime, 1'000'000);
}

TEST_F(RecordingExportTest, SameRecordingGivesSameBytes) {
  image(0);
  image(33);
  for (const std::int64_t ms : {0, 33}) pose(ms, Vec3::UnitX());
  const auto bytes = [this] {
    write();
    std::ifstream file(log_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = bytes();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(bytes(), first);
}

TEST_F(RecordingExportTest, NamesImageOfAnotherSize) {
  image(0);
  recording_.images.push_back({at(33), 1, folder_.write("odd.png", encodeDepthPng({1, 2}, 2, 1))});
  EXPECT_THAT([this] { write(); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("odd.png"), HasSubstr("2x1 px"), HasSubstr("3x2"))));
}

TEST_F(RecordingExportTest, NamesUnreadableImage) {
  recording_.images.push_back({at(0), 0, folder_.path() / "absent.png"});
  EXPECT_THAT([this] { write(); }, ThrowsMessage<std::runtime_error>(HasSubstr("absent.png")));
}

}  // namespace
}  // namespace nanomap
