#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/replay/replaying.h"
#include "tools/replay/warnings.h"

namespace nanomap::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Nasty input in the middle of a good flight of eleven frames: it has its own count, and loses nothing that was good.
class InputFault : public ::testing::Test {
 protected:
  InputFault() : log_(testFile("flight")) { log_.camera(0); }

  /// Ends the flight and replays it.
  ReplayReport result() {
    log_.fly(0, 1000);
    ReplayReport report = replayed(log_.close());
    expectEveryFrameCounted(report);
    EXPECT_EQ(report.chain.views_inserted, 11U);
    EXPECT_EQ(report.answered_frames, 11U);
    return report;
  }

  FlightLog log_;
};

constexpr auto kDepth = static_cast<std::size_t>(InputKind::kDepth);
constexpr auto kPose = static_cast<std::size_t>(InputKind::kPose);

TEST_F(InputFault, FrameFromTheFuture) {
  log_.writer().write("DEPTH", atMs(500), toMessage(FlightLog::flightImage(5000), "front", DepthCompression::kBlosc));
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.chain.views_dropped, ViewDrop::kFromFuture), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("same clock")));
}

TEST_F(InputFault, LateFrame) {
  log_.writer().write("DEPTH", atMs(505), toMessage(FlightLog::flightImage(250), "front", DepthCompression::kRaw));
  EXPECT_EQ(countOf(result().chain.views_dropped, ViewDrop::kLate), 1U);
}

TEST_F(InputFault, DuplicatedFrame) {
  log_.depth(500);
  EXPECT_EQ(countOf(result().chain.views_dropped, ViewDrop::kDuplicate), 1U);
}

TEST_F(InputFault, ImageOfAnotherSize) {
  log_.depth(550, [](DepthImage& image) {
    image.width_px /= 2;
    image.pixels.resize(image.pixels.size() / 2);
  });
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.image_faults, ImageFault::kSizeMismatch), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("another size")));
}

TEST_F(InputFault, ImageOfAnotherDepthUnit) {
  log_.depth(550, [](DepthImage& image) { image.depth_unit_m = 0.0001; });
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.image_faults, ImageFault::kUnitMismatch), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("another depth unit")));
}

TEST_F(InputFault, ImageWithoutPixels) {
  log_.depth(550, [](DepthImage& image) {
    image.width_px = image.height_px = 0;
    image.pixels.clear();
  });
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.image_faults, ImageFault::kEmpty) + sumOf(report.pipeline.convert_faults[kDepth]),
            1U);
}

TEST_F(InputFault, ImageWithFewerBytesThanItsSizeSays) {
  depth_image_t message = toMessage(FlightLog::flightImage(550), "front", DepthCompression::kRaw);
  message.data.resize(message.data.size() / 2);
  message.size /= 2;
  log_.writer().write("DEPTH", atMs(550), message);
  EXPECT_EQ(countOf(result().pipeline.convert_faults[kDepth], ConvertFault::kSizeMismatch), 1U);
}

TEST_F(InputFault, MessageCutShort) {
  const depth_image_t message = toMessage(FlightLog::flightImage(550), "front", DepthCompression::kRaw);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, message.getEncodedSize());
  log_.writer().writeEncoded("DEPTH", atMs(550), std::span(bytes).first(bytes.size() / 2));
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.decode_faults[kDepth], DecodeFault::kTruncated), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("1 of 12 messages on channel DEPTH are damaged")));
}

TEST_F(InputFault, MessageOfAnotherType) {
  log_.writer().write("DEPTH", atMs(550), toMessage(FlightLog::flightPose(550), std::nullopt));
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.decode_faults[kDepth], DecodeFault::kWrongType), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("is lcm.depth_channel the right channel?")));
}

TEST_F(InputFault, FrameWithoutAnyReturn) {
  log_.depth(550, [](DepthImage& image) { image.pixels.assign(image.pixels.size(), 0); });
  log_.fly(0, 1000);
  const ReplayReport report = replayed(log_.close());
  EXPECT_EQ(report.chain.views_inserted, 12U) << "an image of nothing but sky is an image";
}

TEST_F(InputFault, FrameOfAnotherCamera) {
  log_.writer().write("DEPTH", atMs(550), toMessage(FlightLog::flightImage(550), "rear", DepthCompression::kRaw));
  EXPECT_EQ(countOf(result().pipeline.camera_faults, CameraFault::kOtherCamera), 1U);
}

TEST_F(InputFault, PoseThatIsNotFinite) {
  log_.pose(555, [](BodyPose& pose) { pose.T_W_B.translation_m.x() = std::numeric_limits<double>::quiet_NaN(); });
  log_.pose(556, [](BodyPose& pose) { pose.T_W_B.rotation.w() = std::numeric_limits<double>::infinity(); });
  EXPECT_EQ(countOf(result().chain.poses, PoseVerdict::kNotFinite), 2U);
}

TEST_F(InputFault, PoseWithoutAUnitQuaternion) {
  log_.pose(555, [](BodyPose& pose) { pose.T_W_B.rotation.coeffs() *= 1.1; });
  EXPECT_EQ(countOf(result().chain.poses, PoseVerdict::kNotUnit), 1U);
}

TEST_F(InputFault, PoseSentTwice) {
  log_.pose(550);
  EXPECT_EQ(countOf(result().chain.poses, PoseVerdict::kDuplicate), 1U);
}

TEST_F(InputFault, TwoPosesWithOneStamp) {
  log_.pose(995);
  log_.pose(995, [](BodyPose& pose) { pose.T_W_B.translation_m.y() = 0.5; });
  EXPECT_EQ(countOf(result().chain.poses, PoseVerdict::kConflict), 1U);
}

TEST_F(InputFault, PoseFromBackThen) {
  log_.writer().write("POSE_BODY", atMs(555), toMessage(FlightLog::flightPose(333), std::nullopt));
  EXPECT_EQ(result().chain.posesAccepted(), 102U);
}

TEST_F(InputFault, PoseWithANegativeStamp) {
  body_pose_t message = toMessage(FlightLog::flightPose(550), std::nullopt);
  message.utime = -5;
  log_.writer().write("POSE_BODY", atMs(550), message);
  EXPECT_EQ(countOf(result().pipeline.convert_faults[kPose], ConvertFault::kBadStamp), 1U);
}

TEST_F(InputFault, CameraThatCannotBe) {
  CameraParameters broken = smallCamera();
  broken.max_range_m = 0.0;
  log_.camera(550, broken);
  const ReplayReport report = result();
  EXPECT_EQ(countOf(report.pipeline.cameras, CameraVerdict::kInvalid), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("max_range_m")));
}

TEST_F(InputFault, EmptyCorrection) {
  log_.correction(550, {});
  EXPECT_EQ(countOf(result().chain.corrections, CorrectionVerdict::kEmpty), 1U);
}

TEST(InputOrder, FrameBeforeAnyCameraIsDroppedAndCounted) {
  FlightLog log(testFile("flight"));
  log.fly(0, 100);
  log.camera(150);
  log.fly(160, 300);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(countOf(report.pipeline.camera_faults, CameraFault::kNoCamera), 2U);
  EXPECT_EQ(report.chain.views_inserted, 2U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("2 depth frames came before the first camera model")));
  expectEveryFrameCounted(report);
}

TEST(InputOrder, LogWithoutACameraIsExplained) {
  FlightLog log(testFile("flight"));
  log.fly(0, 100);
  const ReplayReport report = replayed(log.close());
  EXPECT_FALSE(report.has_camera);
  EXPECT_EQ(report.answered_frames, 0U);
  EXPECT_EQ(countOf(report.pipeline.camera_faults, CameraFault::kNoCamera), 2U);
  EXPECT_THAT(explainMissingCamera(report, {}),
              ::testing::AllOf(HasSubstr("channel CAMERA"), HasSubstr("DEPTH, POSE_BODY"), HasSubstr("[camera]")));
}

TEST(InputOrder, FrameBeforeEveryPoseIsDropped) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.depth(0);
  log.pose(50);
  log.pose(60);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(countOf(report.chain.views_dropped, ViewDrop::kNoPose), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("older than every pose")));
  expectEveryFrameCounted(report);
}

TEST(InputOrder, FrameAheadOfItsPoseWaits) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.pose(0);
  log.depth(20);
  log.pose(30);
  log.depth(40);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(report.chain.views_inserted, 1U);
  EXPECT_EQ(report.views_waiting, 1U);
  expectEveryFrameCounted(report);
}

TEST(InputOrder, FrameInAGapOfThePosesIsDropped) {
  FlightLog log(testFile("flight"));
  log.camera(0);
  log.pose(0);
  log.depth(200);
  log.pose(400);
  const ReplayReport report = replayed(log.close());
  EXPECT_EQ(countOf(report.chain.views_dropped, ViewDrop::kPoseGap), 1U);
  EXPECT_THAT(warningsOf(report, {}), Contains(HasSubstr("history.max_pose_gap_s")));
}

}  // namespace
}  // namespace nanomap::test
