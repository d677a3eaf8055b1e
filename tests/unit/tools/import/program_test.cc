#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "png_files.h"
#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// nanomap-import as a person starts it.
class ImportProgramTest : public testing::Test {
 protected:
  struct Ended {
    int exit_code = 0;
    std::string out;
    std::string err;
  };
  Ended import(const std::string& options) {
    const auto out = folder_.path() / "stdout";
    const auto err = folder_.path() / "stderr";
    const std::string command = std::string(NANOMAP_IMPORT) + " '" + folder_.path().string() + "' --out '" +
                                log_.string() + "' " + options + " >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(out), contentOf(err)};
  }
  void writeTumFolder() {
    folder_.write("depth.txt", "# stamp file\n0.990 depth/a.png\n1.023 depth/b.png\n");
    folder_.write("groundtruth.txt", "0.985 1 2 3 -0.5 0.5 -0.5 0.5\n1.005 1 2 3 -0.5 0.5 -0.5 0.5\n");
    for (const char* name : {"depth/a.png", "depth/b.png"}) folder_.write(name, encodeDepthPng({5000, 0}, 2, 1));
  }
  void writeNumberedFrame(const std::string& number, unsigned width) {
    folder_.write(number + ".depth.png", encodeDepthPng(std::vector<std::uint16_t>(width, 1500), width, 1));
    folder_.write(number + ".pose.txt", "1 0 0 0.5\n0 1 0 0\n0 0 1 2\n0 0 0 1\n");
  }
  template <class Message>
  Message first() {
    LogReader reader(log_);
    std::vector<std::uint8_t> bytes;
    for (const LogEvent& event : reader.events()) {
      reader.read(event, bytes);
      if (messageHash(bytes) == Message::getHash()) return std::get<Message>(decode<Message>(bytes));
    }
    throw std::runtime_error("the log holds no such message");
  }

  TemporaryFolder folder_;
  std::filesystem::path log_ = folder_.path() / "out.log";
};

constexpr const char* kCamera = "--fx 10 --fy 11 --cx 0.5 --cy 0 --max-range 8 ";

TEST_F(ImportProgramTest, TakesTumFolderInItsUnitAndWorld) {
  writeTumFolder();
  const Ended run = import(kCamera);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("2 images of 2x1 px"), HasSubstr("1 images lie outside the time of the poses")));
  const auto camera = first<camera_model_t>();
  EXPECT_EQ(camera.depth_unit, 0.0002);
  EXPECT_EQ(camera.fy, 11.0);
  EXPECT_EQ(camera.max_range, 8.0);
  const auto pose = first<body_pose_t>();
  EXPECT_EQ(pose.utime, 985'000);
  EXPECT_EQ(pose.world_from_body.translation[2], 3.0);
  EXPECT_NEAR(std::abs(pose.world_from_body.rotation[0]), 1.0, 1e-12);
}

TEST_F(ImportProgramTest, TurnsCameraLikeWorldUpright) {
  writeNumberedFrame("000007", 2);
  ASSERT_EQ(import(kCamera).exit_code, 0);
  const auto pose = first<body_pose_t>();
  EXPECT_EQ(pose.world_from_body.translation[0], 2.0);   // forward in the recording's z
  EXPECT_EQ(pose.world_from_body.translation[1], -0.5);  // left against its x
  EXPECT_NEAR(std::abs(pose.world_from_body.rotation[0]), 1.0, 1e-12);

  ASSERT_EQ(import(std::string(kCamera) + "--world flu").exit_code, 0);
  EXPECT_EQ(first<body_pose_t>().world_from_body.translation[0], 0.5);
}

TEST_F(ImportProgramTest, OptionsOverrideRateUnitRangeAndNoReturn) {
  writeNumberedFrame("000010", 2);
  writeNumberedFrame("000011", 2);
  const Ended run =
      import(std::string(kCamera) +
             "--rate 10 --depth-unit 0.0001 --min-range 0.2 --no-return 0,1500 --distortion 0,0,0,0,0.001 "
             "--max-frames 1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(first<depth_image_t>().utime, 1'000'000);
  const auto camera = first<camera_model_t>();
  EXPECT_EQ(camera.depth_unit, 0.0001);
  EXPECT_EQ(camera.min_range, 0.2);
  EXPECT_EQ(camera.distortion[4], 0.001);
  EXPECT_THAT(camera.no_return_values, testing::ElementsAre(0, 1500));
  EXPECT_THAT(run.out, HasSubstr("1 images"));
}

TEST_F(ImportProgramTest, SaysWhatACameraNeeds) {
  writeNumberedFrame("000000", 2);
  const Ended run = import("--fx 10");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("nanomap-import: camera unknown: give --preset, or --fx"));
  EXPECT_THAT(import(std::string(kCamera) + "--min-range 9").err, HasSubstr("max_range_m must be above min_range_m"));
  EXPECT_THAT(import("--preset kinect-office").err, HasSubstr("2x1 px, but the camera has 640x480"));
  EXPECT_NE(import("--preset nobody").exit_code, 0);
}

TEST_F(ImportProgramTest, FaultyRecordingLeavesOlderLogAsItWas) {
  folder_.write("out.log", "an older log");
  writeNumberedFrame("000000", 2);
  writeNumberedFrame("000001", 3);
  const Ended run = import(kCamera);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("000001.depth.png"), HasSubstr("3x1 px, but the camera has 2x1")));
  EXPECT_EQ(contentOf(log_), "an older log");
  EXPECT_FALSE(std::filesystem::exists(log_.string() + ".part"));
}

}  // namespace
}  // namespace nanomap
