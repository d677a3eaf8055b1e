#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>

#include "drivers/lcm/convert.h"
#include "firmware_app/configuration/load.h"
#include "tests/integration/doctor/findings.h"
#include "tests/integration/doctor/recorded_flight.h"
#include "tests/support/temporary_folder.h"
#include "tools/doctor/gather_log.h"

namespace nanomap::test {
namespace {

using doctor::Findings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One mistake each, in what a log holds or in what is configured for it: the doctor names that one, and no other.
class LogMistakeTest : public ::testing::Test {
 protected:
  Findings diagnose(const Mistake& mistake, std::vector<std::string> overrides = {}) {
    overrides.emplace_back("lcm.clock=realtime");
    doctor::Facts facts;
    facts.configuration = loadConfiguration({}, overrides);
    LogReader log(writeFlight(folder_.path() / "flight.lcmlog", mistake));
    facts.heard = doctor::hearLog(log, facts.configuration.lcm);
    return doctor::diagnose(facts);
  }

  TemporaryFolder folder_;
};

/// Turns the camera about an axis of the body.
Mistake turnedCamera(const Vec3& axis_B, double angle_deg) {
  return {.camera = [=](camera_model_t& camera) {
    Pose T_B_C = toPose(camera.body_from_camera);
    T_B_C.rotation = Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180.0, axis_B) * T_B_C.rotation;
    camera.body_from_camera = toMessage(T_B_C);
  }};
}

Mistake wrongUnitEverywhere(double factor) {
  return {.camera = [=](camera_model_t& camera) { camera.depth_unit *= factor; },
          .depth = [=](depth_image_t& image) { image.depth_unit *= factor; }};
}

Mistake shiftedFrames(Duration shift) {
  return {.depth = [=](depth_image_t& image) {
    image.utime += std::chrono::duration_cast<std::chrono::microseconds>(shift).count();
  }};
}

TEST_F(LogMistakeTest, HealthyFlightIsFoundHealthy) {
  const Findings findings = diagnose({});
  EXPECT_THAT(failed(findings), IsEmpty()) << toText(findings);
  for (const doctor::Finding& finding : findings) {
    EXPECT_NE(finding.verdict, doctor::Verdict::kWarning) << toText(findings);
  }
  EXPECT_THAT(failed(diagnose({.pose_t = BodyConvention::kFlu})), IsEmpty());
  EXPECT_THAT(failed(diagnose({.pose_t = BodyConvention::kFrd}, {"lcm.pose_t_body=frd"})), IsEmpty());
}

TEST_F(LogMistakeTest, CameraRotatedBy90DegreesIsNamedWithTheRotationThatFits) {
  for (const Vec3& axis_B : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    for (const double angle_deg : {90.0, -90.0, 180.0}) {
      const Findings findings = diagnose(turnedCamera(axis_B, angle_deg));
      EXPECT_THAT(failed(findings), ElementsAre("mount")) << toText(findings);
      EXPECT_THAT(fixOf(findings, "mount"), HasSubstr("camera.mount_roll_pitch_yaw_deg = [0, 0, 0]"));
    }
  }
}

TEST_F(LogMistakeTest, CameraThatIsTiltedOtherwiseIsNamed) {
  EXPECT_THAT(failed(diagnose(turnedCamera(Vec3::UnitY(), 15.0))), ElementsAre("mount"));
  EXPECT_THAT(failed(diagnose(turnedCamera(Vec3::UnitZ(), -20.0))), ElementsAre("mount"));
}

TEST_F(LogMistakeTest, DepthUnitOfCameraAloneContradictsFrames) {
  const Findings findings = diagnose({.camera = [](camera_model_t& camera) { camera.depth_unit = 0.01; }});
  EXPECT_THAT(failed(findings), ElementsAre("depth unit")) << toText(findings);
  EXPECT_THAT(fixOf(findings, "depth unit"), HasSubstr("camera.depth_unit_m = 0.001,"));
}

TEST_F(LogMistakeTest, DepthUnitThatIsWrongEverywhereIsSeenInDepthsOrInMotion) {
  for (const double factor : {0.001, 0.1, 10.0, 1000.0}) {
    const Findings findings = diagnose(wrongUnitEverywhere(factor));
    EXPECT_THAT(failed(findings), ElementsAre("depth unit")) << factor << "\n" << toText(findings);
    EXPECT_THAT(fixOf(findings, "depth unit"), HasSubstr("camera.depth_unit_m = 0.001"));
  }
}

TEST_F(LogMistakeTest, FramesShiftedAgainstPosesAreNamed) {
  using namespace std::chrono_literals;
  for (const Duration shift : std::initializer_list<Duration>{-2s, -400ms, -100ms, 100ms, 400ms, 2s}) {
    const Findings findings = diagnose(shiftedFrames(shift));
    EXPECT_THAT(failed(findings), ElementsAre("clock")) << toSeconds(shift) << "\n" << toText(findings);
  }
}

TEST_F(LogMistakeTest, BodyOfTheOtherConventionIsNamed) {
  const Findings frd = diagnose({.pose_t = BodyConvention::kFrd});
  EXPECT_THAT(failed(frd), ElementsAre("body axes")) << toText(frd);
  EXPECT_THAT(fixOf(frd, "body axes"), HasSubstr("lcm.pose_t_body = \"frd\""));
  const Findings flu = diagnose({.pose_t = BodyConvention::kFlu}, {"lcm.pose_t_body=frd"});
  EXPECT_THAT(failed(flu), ElementsAre("body axes")) << toText(flu);
  EXPECT_THAT(fixOf(flu, "body axes"), HasSubstr("lcm.pose_t_body = \"flu\""));
}

TEST_F(LogMistakeTest, ChannelOfAnotherNameIsFoundByItsType) {
  const Findings depth = diagnose({}, {"lcm.depth_channel=DEPTH_FRONT"});
  EXPECT_THAT(failed(depth), ElementsAre("channels")) << toText(depth);
  EXPECT_THAT(fixOf(depth, "channels"), HasSubstr("lcm.depth_channel = \"DEPTH\""));
  const Findings pose = diagnose({}, {"lcm.pose_channel=POSE"});
  EXPECT_THAT(failed(pose), ElementsAre("channels")) << toText(pose);
  EXPECT_THAT(fixOf(pose, "channels"), HasSubstr("lcm.pose_channel = \"POSE_BODY\""));
}

/// As a person starts it.
TEST_F(LogMistakeTest, ProgramNamesMisspeltKeyAndSaysByItsExitCodeWhetherAllIsWell) {
  const std::filesystem::path log = writeFlight(folder_.path() / "flight.lcmlog", {});
  const std::filesystem::path out = folder_.path() / "out";
  const auto run = [&](const std::string& options) {
    const std::string command =
        std::string(NANOMAP_DOCTOR) + " '" + log.string() + "' " + options + " >'" + out.string() + "' 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const auto said = [&] {
    std::ifstream file(out);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(run("--set lcm.clock=realtime"), 0) << said();
  EXPECT_THAT(said(), HasSubstr("0 to mend"));
  const auto config = folder_.write("vehicle.toml", "[lcm]\ndepth_chanel = \"DEPTH\"\n");
  EXPECT_EQ(run("--config '" + config.string() + "'"), 1);
  EXPECT_THAT(said(), HasSubstr("unknown key 'lcm.depth_chanel': did you mean 'lcm.depth_channel'?"));
  EXPECT_THAT(said(), HasSubstr("1 to mend"));
}

}  // namespace
}  // namespace nanomap::test
