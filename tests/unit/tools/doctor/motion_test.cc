#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/drawn_world.h"
#include "tests/unit/tools/doctor/vehicle.h"
#include "tools/doctor/mount_trials.h"

namespace nanomap::doctor {
namespace {

using testing::HasSubstr;

/// A vehicle with a perfect camera flies through a few blocks, turning as it goes.
Heard flight(const CameraParameters& camera, double speed_m_s) {
  const test::DrawnWorld world{.blocks = {{{6, -3, 0}, {7, -1, 3}}, {{5, 1, 0}, {6, 2, 1}}, {{9, -6, 0}, {10, 6, 5}}}};
  const CameraModel model(camera);
  Heard heard;
  constexpr int kFrames = 12;
  constexpr int kPeriod_ms = 200;
  for (int i = 0; i < kFrames; ++i) {
    const double elapsed_s = i * kPeriod_ms * 1e-3;
    BodyPose pose;
    pose.stamp = atMs(1'000 + i * kPeriod_ms);
    pose.T_W_B.translation_m = {speed_m_s * elapsed_s, 0.3 * speed_m_s * elapsed_s, 1.5};
    pose.T_W_B.rotation = Quat(Eigen::AngleAxisd(0.2 * speed_m_s * elapsed_s, Vec3(0.2, 0.3, 1.0).normalized()));
    heard.poses.push_back(pose);
    heard.frames.push_back({"front", world.seenBy(model, pose.T_W_B, pose.stamp)});
  }
  return heard;
}

constexpr Duration kGap = std::chrono::milliseconds(500);

TEST(Agreement, IsWholeOfAPerfectCameraAndLessOfATurnedOne) {
  const CameraParameters camera = test::smallCamera();
  const Heard heard = flight(camera, 1.0);
  const MotionEvidence evidence = motionEvidence(heard, camera, kGap);
  ASSERT_TRUE(evidence.configured);
  EXPECT_GT(evidence.configured->agreement, 0.85);
  EXPECT_EQ(evidence.better(), nullptr);
  for (const Hypothesis& other : evidence.others) {
    if (other.kind == Hypothesis::Kind::kMount && other.agreement < evidence.configured->agreement) {
      EXPECT_LT(other.agreement, 0.7) << other.text;
    }
  }
}

TEST(MotionEvidence, TellsNothingOfAVehicleThatStands) {
  const CameraParameters camera = test::smallCamera();
  EXPECT_FALSE(motionEvidence(flight(camera, 0.0), camera, kGap).configured);
  EXPECT_FALSE(motionEvidence({}, camera, kGap).configured);
}

TEST(MotionEvidence, FindsTheMountThatWasMeant) {
  const CameraParameters meant = test::smallCamera();
  for (const MountTrial& wrong : mountTrials(meant.T_B_C.rotation)) {
    CameraParameters configured = meant;
    configured.T_B_C.rotation = wrong.R_B_C;
    const MotionEvidence evidence = motionEvidence(flight(meant, 1.0), configured, kGap);
    ASSERT_NE(evidence.better(), nullptr) << wrong.mistake;
    EXPECT_EQ(evidence.better()->kind, Hypothesis::Kind::kMount);
    EXPECT_LT(evidence.better()->trial.T_B_C.rotation.angularDistance(meant.T_B_C.rotation), 0.1) << wrong.mistake;
  }
}

TEST(MountCheck, NamesKeyOfConfigurationAndFieldOfMessage) {
  Facts facts = healthyFacts();
  facts.heard->camera->parameters.T_B_C.rotation =
      Eigen::AngleAxisd(std::numbers::pi / 2.0, Vec3::UnitX()) * test::smallCamera().T_B_C.rotation;
  const MotionEvidence evidence = motionEvidence(flight(test::smallCamera(), 1.0), *facts.camera(), kGap);
  EXPECT_THAT(fixesOf(checkMount(facts, evidence)), HasSubstr("body_from_camera.rotation = [0.5, -0.5, 0.5, -0.5]"));
  facts.configuration.camera = facts.heard->camera->parameters;
  EXPECT_THAT(fixesOf(checkMount(facts, evidence)), HasSubstr("camera.mount_roll_pitch_yaw_deg = [0, 0, 0]"));
}

TEST(MountTrials, AreTheCubesRotationsWithoutTheConfiguredOne) {
  const Quat straight = test::forwardMount().rotation;
  EXPECT_EQ(mountTrials(straight).size(), 23U);
  const Quat tilted = Eigen::AngleAxisd(0.3, Vec3::UnitY()) * straight;
  const std::vector<MountTrial> trials = mountTrials(tilted);
  EXPECT_GT(trials.size(), 40U);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_GT(trials[i].R_B_C.angularDistance(tilted), 0.01);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(trials[i].R_B_C.angularDistance(trials[j].R_B_C), 0.01);
  }
  EXPECT_EQ(trials.front().mistake, "the sign of its pitch is wrong");
}

TEST(DepthUnitCheck, MostDepthsLieWithinTheCamerasRange) {
  Facts facts = healthyFacts();
  EXPECT_EQ(verdictOf(checkDepthUnit(facts, nullptr)), Verdict::kNotLookedAt) << "no frames";
  const CameraModel camera(facts.heard->camera->parameters);
  const auto judged = [&](std::uint16_t raw) {
    facts.heard->frames = {{"front", test::flatImage(camera, raw)}};
    return checkDepthUnit(facts, nullptr);
  };
  EXPECT_EQ(verdictOf(judged(5'000)), Verdict::kOk);
  EXPECT_EQ(verdictOf(judged(0)), Verdict::kWarning) << "no depth";
  EXPECT_THAT(fixesOf(judged(50'000)), HasSubstr("camera.depth_unit_m = 0.0001, with"));
  EXPECT_THAT(fixesOf(judged(50)), HasSubstr("camera.depth_unit_m = 0.01, with"));
}

TEST(CameraCheck, FramesOfAnotherSizeOrNameFail) {
  Facts facts = healthyFacts();
  const CameraModel other(test::smallCamera(32, 24));
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kOk);
  facts.heard->frames = {{"front", test::flatImage(other, 100)}};
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kFailure);
  facts.heard->frames = {{"rear", test::flatImage(CameraModel(test::smallCamera()), 100)}};
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kFailure);
  facts.configuration.camera = test::smallCamera();
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kOk) << "a configured camera has no name";
  facts.configuration.camera->fx_px *= 2.0;
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kWarning);
}

TEST(CameraCheck, CameraThatCannotBeIsAFailureNotAnException) {
  Facts facts = healthyFacts();
  facts.heard->camera->parameters.fx_px = -1.0;
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kFailure);
  facts.heard->camera.reset();
  EXPECT_EQ(verdictOf(checkCamera(facts)), Verdict::kFailure);
}

}  // namespace
}  // namespace nanomap::doctor
