#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "firmware_app/configuration/camera_mount.h"
#include "tests/unit/tools/doctor/vehicle.h"
#include "tools/doctor/diagnosis.h"
#include "tools/doctor/floor_evidence.h"
#include "tools/generate/paper_camera.h"
#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/ray_caster.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::doctor {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

constexpr double kOnTheGround_m = 0.25;
constexpr double kPitch_rad = 0.05;  // of the body, as it stands

/// A vehicle that stands where a scene's flight begins, its camera configured as one that looks straight ahead.
class VehicleThatStands : public ::testing::TestWithParam<std::string> {
 protected:
  /// What is heard of it if its camera is in fact mounted like that, under noise.
  /// @param yaw_rad  from the direction of the goal
  [[nodiscard]] Facts heardWith(const MountAngles& mount, double height_m, double yaw_rad = 0.0) const {
    const CameraParameters configured = generate::paperCamera(160, 120);
    CameraParameters actual = configured;
    actual.T_B_C.rotation = rotationOfMount(mount);
    const CameraModel camera(actual);
    const simulation::DepthSensor sensor(camera, {}, kSeed);

    const Vec3 ahead_W = scene_.mission().goal_W - scene_.mission().start_W;
    Pose T_W_B{Quat(Eigen::AngleAxisd(std::atan2(ahead_W.y(), ahead_W.x()) + yaw_rad, Vec3::UnitZ()) *
                    Eigen::AngleAxisd(kPitch_rad, Vec3::UnitY())),
               scene_.mission().start_W};
    T_W_B.translation_m.z() = height_m;

    Facts facts = healthyFacts();
    facts.heard->camera->parameters = configured;
    for (BodyPose& pose : facts.heard->poses) pose.T_W_B = T_W_B;
    for (std::uint64_t i = 0; i < 3; ++i) {
      const Time stamp = atMs(1'100 + 200 * static_cast<std::int64_t>(i));
      facts.heard->frames.push_back({"front", sensor.measure(caster_.render(camera, T_W_B * actual.T_B_C), stamp, i)});
    }
    return facts;
  }

  [[nodiscard]] static Findings judged(const Facts& facts) {
    const CameraModel camera(*facts.camera());
    return checkMountAtRest(facts, floorEvidence(*facts.heard, camera, facts.configuration.chain.max_pose_gap));
  }

  /// The mount that is to be configured instead is that one.
  static void expectNamed(const Findings& findings, const MountAngles& mount) {
    constexpr double kNear_deg = 3.0;
    const std::string fixes = fixesOf(findings);
    MountAngles named;
    ASSERT_EQ(std::sscanf(fixes.c_str(), "camera.mount_roll_pitch_yaw_deg = [%lf, %lf, %lf]", &named.roll_deg,
                          &named.pitch_deg, &named.yaw_deg),
              3)
        << fixes;
    EXPECT_NEAR(std::remainder(named.roll_deg - mount.roll_deg, 360.0), 0.0, kNear_deg);
    EXPECT_NEAR(named.pitch_deg, mount.pitch_deg, kNear_deg);
    EXPECT_NEAR(named.yaw_deg, mount.yaw_deg, kNear_deg);
  }

  [[nodiscard]] double startHeight_m() const { return scene_.mission().start_W.z(); }

  static constexpr std::uint64_t kSeed = 1;
  simulation::Scene scene_ = simulation::makeScene(GetParam(), kSeed);
  simulation::RayCaster caster_{scene_.mesh()};
};

TEST_P(VehicleThatStands, RightMountIsFoundRight) {
  for (const double height_m : {kOnTheGround_m, startHeight_m()}) {
    for (const double yaw_rad : {0.0, 0.6, -1.5}) {
      const Findings findings = judged(heardWith({}, height_m, yaw_rad));
      EXPECT_EQ(verdictOf(findings), Verdict::kOk) << height_m << " m, " << yaw_rad << ": " << toText(findings);
    }
  }
}

TEST_P(VehicleThatStands, MountThatIsTurnedByAQuarterIsNeverFoundRight) {
  for (const double roll_deg : {90.0, -90.0, 180.0}) {
    for (const double yaw_rad : {0.0, 0.6, -1.5}) {
      const Findings findings = judged(heardWith({roll_deg, 0.0, 0.0}, kOnTheGround_m, yaw_rad));
      EXPECT_NE(verdictOf(findings), Verdict::kOk) << roll_deg << ", " << yaw_rad << ": " << toText(findings);
      EXPECT_THAT(findings[0].seen + findings[0].fix,
                  AnyOf(HasSubstr("carry it a metre"), HasSubstr("camera.mount_roll")));
    }
  }
}

TEST_P(VehicleThatStands, TiltedMountIsNamedByItsAngles) {
  for (const MountAngles& mount : {MountAngles{.pitch_deg = 20.0}, MountAngles{.roll_deg = 20.0}}) {
    Facts facts = heardWith(mount, kOnTheGround_m);
    facts.configuration.camera = facts.camera();
    const Findings findings = judged(facts);
    EXPECT_EQ(verdictOf(findings), Verdict::kFailure) << toText(findings);
    expectNamed(findings, mount);
  }
}

TEST_P(VehicleThatStands, SkyAloneIsSaidToTellNothing) {
  const Findings findings = judged(heardWith({.pitch_deg = -90.0}, startHeight_m()));
  EXPECT_EQ(verdictOf(findings), Verdict::kNotLookedAt) << toText(findings);
}

INSTANTIATE_TEST_SUITE_P(Scenes, VehicleThatStands, ::testing::Values("forest", "wall", "warehouse", "urban"),
                         [](const auto& parameter) { return parameter.param; });

using VehicleWithRoom = VehicleThatStands;

TEST_P(VehicleWithRoom, QuarterTurnsAreNamedWithTheMountThatFits) {
  for (const double roll_deg : {90.0, -90.0, 180.0}) {
    Facts facts = heardWith({roll_deg, 0.0, 0.0}, startHeight_m());
    facts.configuration.camera = facts.camera();
    const Findings findings = judged(facts);
    EXPECT_EQ(verdictOf(findings), Verdict::kFailure) << toText(findings);
    expectNamed(findings, {.roll_deg = roll_deg});
  }
}

TEST_P(VehicleWithRoom, DiagnosisLooksAtTheFloorAsLongAsItStands) {
  const auto mountOf = [](const Facts& facts) {
    std::string lines;
    for (const Finding& finding : diagnose(facts)) {
      if (finding.subject == "mount") lines += std::string(toString(finding.verdict)) + " " + finding.seen;
    }
    return lines;
  };
  EXPECT_THAT(mountOf(heardWith({}, startHeight_m())), HasSubstr("ok the vehicle stands"));
  EXPECT_THAT(mountOf(heardWith({.pitch_deg = 20.0}, startHeight_m())),
              AllOf(HasSubstr("FAIL the vehicle stands"), HasSubstr("degrees off level")));
}

TEST_P(VehicleWithRoom, FramesWithoutAPoseOrOfAnotherSizeTellNothing) {
  Facts facts = heardWith({}, kOnTheGround_m);
  for (DepthInput& frame : facts.heard->frames) frame.image.width_px -= 1;
  EXPECT_EQ(verdictOf(judged(facts)), Verdict::kNotLookedAt);
  facts = heardWith({}, kOnTheGround_m);
  facts.heard->poses.clear();
  EXPECT_EQ(verdictOf(judged(facts)), Verdict::kNotLookedAt);
  facts.heard->frames.clear();
  EXPECT_EQ(verdictOf(judged(facts)), Verdict::kNotLookedAt);
}

INSTANTIATE_TEST_SUITE_P(Scenes, VehicleWithRoom, ::testing::Values("forest", "wall", "urban"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace nanomap::doctor
