#include "tools/generate/flight_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "nanomap/goal_t.hpp"
#include "tools/generate/paper_camera.h"

namespace nanomap::generate {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

/// A small and short one: a second of warehouse.
FlightLogOptions smallOptions() {
  FlightLogOptions options;
  options.scene = "warehouse";
  options.duration = std::chrono::seconds(1);
  options.camera = paperCamera(32, 24);
  options.vio.drift.horizontal_std_m = 0.7;
  options.vio.drift.vertical_std_m = 0.7;
  return options;
}

template <class Message>
struct Logged {
  Time log_stamp{};
  std::string channel;
  Message message;
};

class FlightLogTest : public testing::Test {
 protected:
  ~FlightLogTest() override { std::filesystem::remove(file_); }

  SensedFlightSummary write(const FlightLogOptions& options) {
    LogWriter log(file_);
    const SensedFlightSummary summary = FlightLog(options).write(LcmParameters(), log);
    log.close();
    return summary;
  }

  std::string bytesOf(const FlightLogOptions& options) {
    write(options);
    std::ifstream file(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  template <class Message>
  std::vector<Logged<Message>> messages() {
    LogReader reader(file_);
    std::vector<Logged<Message>> found;
    std::vector<std::uint8_t> bytes;
    for (const LogEvent& event : reader.events()) {
      reader.read(event, bytes);
      if (messageHash(bytes) != Message::getHash()) continue;
      found.push_back({event.log_stamp, reader.channelOf(event), std::get<Message>(decode<Message>(bytes))});
    }
    return found;
  }

  std::vector<Logged<body_pose_t>> poses(const std::string& channel) {
    std::vector<Logged<body_pose_t>> found = messages<body_pose_t>();
    std::erase_if(found, [&](const auto& logged) { return logged.channel != channel; });
    return found;
  }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("flight_log_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".lcmlog");
};

TEST_F(FlightLogTest, SameSeedWritesTheSameBytes) {
  FlightLogOptions options = smallOptions();
  options.scene = "forest";
  options.correction_hz = 10.0;
  options.jump_m = 1.0;
  const std::string first = bytesOf(options);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(bytesOf(options) == first);
}

TEST_F(FlightLogTest, AnotherSeedWritesOtherBytes) {
  FlightLogOptions options = smallOptions();
  const std::string first = bytesOf(options);
  options.seed = 2;
  EXPECT_FALSE(bytesOf(options) == first);
}

TEST_F(FlightLogTest, HoldsEveryChannelAtItsRate) {
  FlightLogOptions options = smallOptions();
  options.duration = std::chrono::seconds(3);
  options.correction_hz = 2.0;
  const SensedFlightSummary summary = write(options);
  EXPECT_THAT(summary.messages,
              testing::ElementsAre(testing::Pair("CAMERA", 3), testing::Pair("DEPTH", 90), testing::Pair("GOAL", 3),
                                   testing::Pair("POSE_BODY", 300), testing::Pair("POSE_CORRECTION", 5),
                                   testing::Pair("TRUTH_POSE_BODY", 300)));
  EXPECT_THAT(messages<camera_model_t>(), SizeIs(3));
  EXPECT_THAT(messages<depth_image_t>(), SizeIs(90));
  EXPECT_THAT(messages<goal_t>(), SizeIs(3));
  EXPECT_THAT(messages<pose_correction_t>(), SizeIs(5));
  EXPECT_THAT(poses("POSE_BODY"), SizeIs(300));
  EXPECT_THAT(poses(SensedFlight::kTruthChannel), SizeIs(300));
}

TEST_F(FlightLogTest, EventsAreInTheOrderOfTheirArrival) {
  FlightLogOptions options = smallOptions();
  options.correction_hz = 20.0;
  write(options);
  LogReader reader(file_);
  EXPECT_TRUE(std::is_sorted(reader.events().begin(), reader.events().end(),
                             [](const LogEvent& a, const LogEvent& b) { return a.log_stamp < b.log_stamp; }));
  EXPECT_EQ(reader.channelOf(reader.events().front()), "CAMERA");
  EXPECT_THAT(reader.damage(), testing::IsEmpty());
}

TEST_F(FlightLogTest, MessagesArriveAfterWhatTheyDescribe) {
  FlightLogOptions options = smallOptions();
  options.correction_hz = 4.0;
  write(options);
  for (const auto& logged : messages<depth_image_t>()) {
    EXPECT_EQ(logged.log_stamp - std::get<Time>(timeFromUtime(logged.message.utime)), options.depth_latency);
  }
  for (const auto& logged : messages<body_pose_t>()) {
    EXPECT_EQ(logged.log_stamp - std::get<Time>(timeFromUtime(logged.message.utime)), options.pose_latency);
  }
  for (const auto& logged : messages<pose_correction_t>()) {
    const Time newest = std::get<Time>(timeFromUtime(logged.message.poses.back().utime));
    EXPECT_GE(logged.log_stamp - newest, options.correction_delay);
    EXPECT_LE(logged.log_stamp - newest, options.correction_delay + options.vio.keyframe_period);
  }
}

TEST_F(FlightLogTest, CrossesASecondBoundary) {
  write(smallOptions());
  const auto images = messages<depth_image_t>();
  EXPECT_NE(images.front().message.utime / 1'000'000, images.back().message.utime / 1'000'000);
  for (std::size_t i = 1; i < images.size(); ++i) {
    const std::int64_t step_us = images[i].message.utime - images[i - 1].message.utime;
    EXPECT_GE(step_us, 33'333);
    EXPECT_LE(step_us, 33'334);
  }
}

TEST_F(FlightLogTest, ImagesDecodeToWhatTheCameraAnnounces) {
  for (const DepthCompression compression : {DepthCompression::kBlosc, DepthCompression::kRaw}) {
    FlightLogOptions options = smallOptions();
    options.compression = compression;
    const SensedFlightSummary summary = write(options);
    const auto announced = messages<camera_model_t>();
    const CameraModel camera(std::get<CameraParameters>(toCameraParameters(announced.front().message)));
    EXPECT_TRUE(camera.parameters().T_B_C.translation_m.isApprox(options.camera.T_B_C.translation_m));
    std::uint64_t returns = 0;
    std::uint64_t sequence = 0;
    for (const auto& logged : messages<depth_image_t>()) {
      const auto image = std::get<DepthImage>(toDepthImage(logged.message));
      EXPECT_EQ(image.sequence, sequence++);
      EXPECT_EQ(logged.message.camera, announced.front().message.name);
      ASSERT_THAT(image.pixels, SizeIs(camera.pixelCount()));
      returns +=
          image.pixels.size() - static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), 0));
    }
    EXPECT_NEAR(static_cast<double>(returns) / static_cast<double>(30 * camera.pixelCount()), summary.depth_share,
                1e-12);
  }
}

TEST_F(FlightLogTest, ImagesShowTheSceneFromTheTruePose) {
  FlightLogOptions options = smallOptions();
  options.sensor = simulation::DepthSensorParameters::ideal();
  options.depth_hz = 10.0;  // so that every image has a true pose of its stamp
  options.duration = std::chrono::seconds(3);
  write(options);
  const simulation::Scene scene = FlightLog(options).scene();
  const auto truths = poses(SensedFlight::kTruthChannel);
  const CameraModel camera(options.camera);
  int returns = 0;
  for (const auto& logged : messages<depth_image_t>()) {
    const auto truth = std::find_if(truths.begin(), truths.end(), [&](const auto& candidate) {
      return candidate.message.utime == logged.message.utime;
    });
    ASSERT_NE(truth, truths.end());
    const Pose T_W_C = toPose(truth->message.world_from_body) * options.camera.T_B_C;
    const auto image = std::get<DepthImage>(toDepthImage(logged.message));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (image.pixels[i] == 0) continue;
      const Vec3 p_W = T_W_C * camera.deproject(i, image.pixels[i]).cast<double>();
      EXPECT_LT(std::min(std::abs(scene.distanceToNearestObstacle(p_W)), std::abs(p_W.z())), 0.06);
      ++returns;
    }
  }
  EXPECT_GT(returns, 10'000);
}

TEST_F(FlightLogTest, PosesDriftFromTheTruthAndCorrectionsDoNot) {
  FlightLogOptions options = smallOptions();
  options.duration = std::chrono::seconds(6);
  options.depth_hz = 1.0;
  options.correction_hz = 1.0;
  const SensedFlightSummary summary = write(options);
  const auto estimates = poses("POSE_BODY");
  const auto truths = poses(SensedFlight::kTruthChannel);
  ASSERT_EQ(estimates.size(), truths.size());
  EXPECT_EQ(toPose(estimates.front().message.world_from_body).translation_m,
            toPose(truths.front().message.world_from_body).translation_m);
  const double error_m = (toPose(estimates.back().message.world_from_body).translation_m -
                          toPose(truths.back().message.world_from_body).translation_m)
                             .norm();
  EXPECT_GT(error_m, 0.05);
  EXPECT_NEAR(error_m, summary.final_error_m, 1e-9);
  for (const auto& logged : messages<pose_correction_t>()) {
    for (const auto& corrected : logged.message.poses) {
      const auto truth = std::find_if(truths.begin(), truths.end(), [&](const auto& candidate) {
        return candidate.message.utime == corrected.utime;
      });
      ASSERT_NE(truth, truths.end());
      EXPECT_EQ(toPose(corrected.transform).translation_m, toPose(truth->message.world_from_body).translation_m);
    }
  }
}

TEST_F(FlightLogTest, JumpRaisesTheEpochHalfway) {
  FlightLogOptions options = smallOptions();
  options.jump_m = 2.0;
  options.duration = std::chrono::seconds(4);
  options.depth_hz = 1.0;
  write(options);
  const auto estimates = poses("POSE_BODY");
  const Time middle = SensedFlight::kStart + std::chrono::seconds(2);
  for (const auto& logged : estimates) {
    const bool after = std::get<Time>(timeFromUtime(logged.message.utime)) >= middle;
    EXPECT_EQ(logged.message.epoch, after ? 1 : 0);
  }
  const Vec3 before_W = toPose(estimates[199].message.world_from_body).translation_m;
  const Vec3 after_W = toPose(estimates[200].message.world_from_body).translation_m;
  EXPECT_NEAR((after_W - before_W).norm(), 2.0, 0.3);
  EXPECT_EQ(messages<goal_t>().front().message.epoch, 0);
  EXPECT_EQ(messages<goal_t>().back().message.epoch, 1);
}

TEST_F(FlightLogTest, PoseTypeMayBeTheCommonOne) {
  FlightLogOptions options = smallOptions();
  options.pose_type = PoseType::kPose;
  write(options);
  EXPECT_THAT(messages<bot_core::pose_t>(), SizeIs(100));
  EXPECT_THAT(poses("POSE_BODY"), testing::IsEmpty());
  EXPECT_THAT(poses(SensedFlight::kTruthChannel), SizeIs(100));
}

TEST_F(FlightLogTest, WithoutADurationEndsAtTheGoal) {
  FlightLogOptions options = smallOptions();
  options.duration.reset();
  options.depth_hz = 0.5;
  const SensedFlightSummary summary = write(options);
  const Vec3 last_W = toPose(poses(SensedFlight::kTruthChannel).back().message.world_from_body).translation_m;
  const goal_t goal = messages<goal_t>().front().message;
  EXPECT_LT((last_W - Vec3(goal.position)).norm(), 0.1);
  EXPECT_GT(summary.flown_m, 70.0);
  EXPECT_GT(summary.min_clearance_m, options.flight.min_clearance_m - 0.01);
}

TEST_F(FlightLogTest, LongerThanTheFlightHovers) {
  FlightLogOptions options = smallOptions();
  options.duration = std::chrono::seconds(40);
  options.depth_hz = 0.1;
  write(options);
  const auto truths = poses(SensedFlight::kTruthChannel);
  EXPECT_EQ(truths.size(), 4000U);
  EXPECT_EQ(Vec3(truths.back().message.velocity), Vec3::Zero());
}

TEST_F(FlightLogTest, WrongOptionsAreNamed) {
  const auto expectNamed = [](auto change, const std::string& name) {
    FlightLogOptions options = smallOptions();
    change(options);
    EXPECT_THAT([&] { FlightLog{options}; }, ThrowsMessage<std::invalid_argument>(HasSubstr(name)));
  };
  expectNamed([](auto& options) { options.depth_hz = 0.0; }, "depth_hz");
  expectNamed([](auto& options) { options.depth_hz = std::numeric_limits<double>::infinity(); }, "depth_hz");
  expectNamed([](auto& options) { options.correction_hz = -1.0; }, "correction_hz");
  expectNamed([](auto& options) { options.jump_m = std::numeric_limits<double>::quiet_NaN(); }, "jump_m");
  expectNamed([](auto& options) { options.duration = Duration::zero(); }, "duration");
  expectNamed([](auto& options) { options.depth_latency = -Duration(1); }, "depth_latency");
  expectNamed([](auto& options) { options.scene = "forrest"; }, "forrest");
  expectNamed([](auto& options) { options.vio.drift.vertical_std_m = -0.1; }, "vertical_std_m");
  expectNamed([](auto& options) { options.camera.width_px = 0; }, "width");
}

}  // namespace
}  // namespace nanomap::generate
