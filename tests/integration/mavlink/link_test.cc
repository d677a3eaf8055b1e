#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "drivers/mavlink/alignment_estimator.h"
#include "tests/integration/mavlink/companion.h"

namespace nanomap::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::HasSubstr;

LocalNedTarget target() {
  const NedFromWorld T_NED_W(70.0 * std::numbers::pi / 180.0, Vec3(100.0, -20.0, 3.0));
  const MotionSetpoint setpoint{monotonicNow(), {{10.0, 0.1, 2.0}, {2.0, 0.3, -1.0}, {0.1, 1.0, 0.2}}, 0.5};
  return toNed(setpoint, T_NED_W);
}

class EveryWire : public ::testing::TestWithParam<Wire> {};

std::string nameOf(const ::testing::TestParamInfo<Wire>& wire) {
  constexpr const char* kNames[] = {"Udp", "Tcp", "Serial"};
  return kNames[static_cast<std::size_t>(wire.param)];
}

INSTANTIATE_TEST_SUITE_P(Mavlink, EveryWire, ::testing::Values(Wire::kUdp, Wire::kTcp, Wire::kSerial), nameOf);

TEST_P(EveryWire, HasOurIdentityAndState) {
  Companion companion(GetParam());
  ASSERT_TRUE(companion.untilLinked());
  EXPECT_EQ(companion.link.autopilot().kind, AutopilotKind::kPx4);
  EXPECT_FALSE(companion.link.autopilot().armed);
  EXPECT_TRUE(companion.link.takePose());
  ASSERT_TRUE(companion.until([&] { return companion.link.autopilot().landed == LandedState::kOnGround; }));

  const auto told = [&](SystemStatus status) {
    const auto heartbeats = companion.autopilot.messages("HEARTBEAT");
    return !heartbeats.empty() && heartbeats.back().at("fields").at("system_status") == json(status);
  };
  ASSERT_TRUE(companion.until([&] { return told(SystemStatus::kStandby); }));
  companion.status = SystemStatus::kActive;
  ASSERT_TRUE(companion.until([&] { return told(SystemStatus::kActive); }));
  const std::size_t heard = companion.autopilot.messages("HEARTBEAT").size();
  ASSERT_TRUE(companion.untilReceived("HEARTBEAT", heard + 2));

  bool ours = false;
  for (const json& heartbeat : companion.autopilot.messages("HEARTBEAT")) {
    EXPECT_EQ(heartbeat.at("system"), 1);
    EXPECT_EQ(heartbeat.at("component"), 196);
    EXPECT_EQ(heartbeat.at("fields").at("type"), 18);
    ours = ours || heartbeat.at("fields").at("system_status") != 0;
    EXPECT_EQ(heartbeat.at("fields").at("system_status") != 0, ours) << "MAVSDK's own heartbeat after ours";
  }
  EXPECT_EQ(companion.link.counters().malformed, 0U);
}

TEST_P(EveryWire, CarriesSetpointsBitForBit) {
  Companion companion(GetParam());
  EXPECT_EQ(companion.link.send(target()), SendResult::kNoAutopilot);
  ASSERT_TRUE(companion.untilLinked());
  const LocalNedTarget sent = target();
  ASSERT_EQ(companion.link.send(sent), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED"));

  const json message = companion.autopilot.messages("SET_POSITION_TARGET_LOCAL_NED").front();
  EXPECT_EQ(message.at("component"), 196);
  const json& fields = message.at("fields");
  const auto number = [&](const char* name) { return fields.at(name).get<float>(); };
  EXPECT_EQ(fields.at("time_boot_ms"), sent.time_boot_ms);
  EXPECT_EQ(fields.at("target_system"), 1);
  EXPECT_EQ(fields.at("target_component"), 1);
  EXPECT_EQ(fields.at("coordinate_frame"), 1);
  EXPECT_EQ(fields.at("type_mask"), 2048);
  EXPECT_EQ(Vec3f(number("x"), number("y"), number("z")), sent.position_NED_m);
  EXPECT_EQ(Vec3f(number("vx"), number("vy"), number("vz")), sent.velocity_NED_m_s);
  EXPECT_EQ(Vec3f(number("afx"), number("afy"), number("afz")), sent.acceleration_NED_m_s2);
  EXPECT_EQ(number("yaw"), sent.yaw_NED_rad);
  EXPECT_EQ(number("yaw_rate"), 0.0F);
}

TEST_P(EveryWire, IsSilentWhenWeStopSendingSoThatTheFailsafeActs) {
  Companion companion(GetParam());
  ASSERT_TRUE(companion.untilLinked());
  companion.autopilot.order("mode OFFBOARD");
  ASSERT_TRUE(companion.until([&] { return companion.autopilot.saw("refused", "OFFBOARD"); }));  // no stream

  companion.streamed = target();
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED", 10));
  companion.autopilot.order("mode OFFBOARD");
  ASSERT_TRUE(companion.until([&] { return companion.link.autopilot().external_control; }));
  EXPECT_EQ(companion.link.autopilot().external_control_entries, 1U);

  companion.streamed.reset();  // our heartbeats go on
  ASSERT_TRUE(companion.until([&] { return companion.autopilot.saw("mode", "HOLD"); }));
  ASSERT_TRUE(companion.until([&] { return !companion.link.autopilot().external_control; }));
  EXPECT_EQ(companion.autopilot.messages("SET_POSITION_TARGET_LOCAL_NED").size(),
            companion.link.counters().setpoints_sent);
  EXPECT_EQ(companion.link.counters().stale_setpoints, 0U);
}

TEST(Link, LeavesTheAutopilotOfAnotherVehicleAlone) {
  Companion companion(Wire::kUdp, {"--system", "3"});
  EXPECT_FALSE(companion.link.otherAutopilot());
  ASSERT_TRUE(companion.until([&] { return companion.link.otherAutopilot() == 3; }));
  EXPECT_EQ(companion.link.send(target()), SendResult::kNoAutopilot);
  EXPECT_FALSE(companion.link.autopilot().heartbeat_age);
}

TEST(Link, IsToTheVehicleThatItIsConfiguredFor) {
  Companion companion(Wire::kUdp, {"--system", "3"}, 3);
  ASSERT_TRUE(companion.untilLinked());
  EXPECT_FALSE(companion.link.otherAutopilot());
  ASSERT_EQ(companion.link.send(target()), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED"));
  const json message = companion.autopilot.messages("SET_POSITION_TARGET_LOCAL_NED").front();
  EXPECT_EQ(message.at("system"), 3);
  EXPECT_EQ(message.at("fields").at("target_system"), 3);
}

/// Both send to our port, the other vehicle's first.
TEST(Link, OfTwoAutopilotsCommandsTheVehiclesOwn) {
  Companion companion(Wire::kUdp, {"--system", "3"});
  ASSERT_TRUE(companion.until([&] { return companion.link.otherAutopilot() == 3; }));
  const std::string& url = companion.autopilot.url();
  AutopilotProcess ours({"--udp", url.substr(url.rfind(':') + 1)});
  ASSERT_TRUE(companion.untilLinked());
  EXPECT_EQ(companion.link.otherAutopilot(), 3) << "it is still there, and hears what has no addressee";
  ASSERT_EQ(companion.link.send(target()), SendResult::kSent);
  const auto received = [&] {
    ours.read(std::chrono::milliseconds(0));
    return ours.messages("SET_POSITION_TARGET_LOCAL_NED");
  };
  ASSERT_TRUE(companion.until([&] { return !received().empty(); }));
  EXPECT_EQ(received().front().at("fields").at("target_system"), 1);
  for (const json& message : companion.autopilot.messages("SET_POSITION_TARGET_LOCAL_NED")) {
    EXPECT_EQ(message.at("fields").at("target_system"), 1) << "to the other vehicle";
  }
}

TEST(Link, DropsASetpointThatWasHeldUp) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  LocalNedTarget old = target();
  old.time_boot_ms -= 300;
  ASSERT_EQ(companion.link.send(old), SendResult::kSent);
  const LocalNedTarget fresh = target();
  ASSERT_EQ(companion.link.send(fresh), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED"));
  const auto received = companion.autopilot.messages("SET_POSITION_TARGET_LOCAL_NED");
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received.front().at("fields").at("time_boot_ms"), fresh.time_boot_ms);
  EXPECT_EQ(companion.link.counters().stale_setpoints, 1U);
}

TEST(Link, RefusesSetpointsThatAreNotFinite) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  LocalNedTarget bad = target();
  bad.position_NED_m.x() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(companion.link.send(bad), SendResult::kNotFinite);
  EXPECT_EQ(companion.link.counters().refused, 1U);
}

TEST(Link, SeesThePilotTakeOver) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  companion.autopilot.order("arm");
  companion.streamed = target();
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED", 10));
  companion.autopilot.order("mode OFFBOARD");
  ASSERT_TRUE(companion.until([&] { return companion.link.autopilot().external_control; }));
  EXPECT_TRUE(companion.link.autopilot().armed);
  companion.autopilot.order("mode POSCTL");
  ASSERT_TRUE(companion.until([&] { return !companion.link.autopilot().external_control; }));
  EXPECT_EQ(companion.link.autopilot().custom_mode, 3U << 16);
}

TEST(Link, AsksArduPilotForItsTelemetryAndSeesGuided) {
  Companion companion(Wire::kTcp, {"--rules", "ardupilot"});
  ASSERT_TRUE(companion.untilLinked());  // it streams no position unasked
  EXPECT_EQ(companion.link.autopilot().kind, AutopilotKind::kArduPilot);
  companion.autopilot.order("mode GUIDED");
  ASSERT_TRUE(companion.until([&] { return companion.link.autopilot().external_control; }));
  companion.autopilot.order("mode LOITER");
  ASSERT_TRUE(companion.until([&] { return !companion.link.autopilot().external_control; }));
}

TEST(Link, NoticesADeadLineAndItsReturn) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  companion.autopilot.order("telemetry off");
  ASSERT_TRUE(companion.until([&] { return !companion.link.autopilot().linked; }));
  EXPECT_GE(*companion.link.autopilot().heartbeat_age, Companion::kHeartbeatTimeout);
  EXPECT_GE(*companion.link.autopilot().position_age, 1s);
  companion.autopilot.order("telemetry on");
  ASSERT_TRUE(companion.until([&] { return companion.link.autopilot().linked; }));
  EXPECT_EQ(companion.link.send(target()), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("SET_POSITION_TARGET_LOCAL_NED"));
}

TEST(Link, CarriesObstacleDistances) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  ObstacleDistances distances;
  distances.stamp = Time(7s);
  distances.min_distance_cm = 20;
  distances.max_distance_cm = 1000;
  distances.cells_cm[0] = 250;
  distances.cells_cm[71] = distances.clear();
  ASSERT_EQ(companion.link.send(distances), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("OBSTACLE_DISTANCE"));
  const json fields = companion.autopilot.messages("OBSTACLE_DISTANCE").front().at("fields");
  EXPECT_EQ(fields.at("time_usec"), 7'000'000);
  EXPECT_EQ(fields.at("frame"), 12);
  EXPECT_EQ(fields.at("increment"), 5);
  EXPECT_EQ(fields.at("increment_f"), 5.0);
  EXPECT_EQ(fields.at("angle_offset"), 0.0);
  EXPECT_EQ(fields.at("min_distance"), 20);
  EXPECT_EQ(fields.at("max_distance"), 1000);
  EXPECT_EQ(fields.at("distances"), json(distances.cells_cm));
}

TEST(Link, CarriesOdometryInTheAutopilotsTime) {
  Companion companion(Wire::kUdp);
  VioOdometry odometry;
  odometry.epoch = 3;
  odometry.T_W_B.translation_m = Vec3(1.0, 2.0, 3.0);
  odometry.stamp = monotonicNow();
  EXPECT_EQ(companion.link.send(toFrd(odometry)), SendResult::kNoClock);
  ASSERT_TRUE(companion.untilLinked());
  odometry.stamp = monotonicNow() - 1h;  // before its boot
  EXPECT_EQ(companion.link.send(toFrd(odometry)), SendResult::kNoClock);
  odometry.stamp = monotonicNow() - 500ms;
  ASSERT_EQ(companion.link.send(toFrd(odometry)), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("ODOMETRY"));
  const json fields = companion.autopilot.messages("ODOMETRY").front().at("fields");
  EXPECT_EQ(fields.at("frame_id"), 20);
  EXPECT_EQ(fields.at("child_frame_id"), 12);
  EXPECT_EQ(fields.at("y"), -2.0);
  EXPECT_TRUE(fields.at("vx").is_null());
  EXPECT_TRUE(fields.at("pose_covariance").at(0).is_null());
  EXPECT_EQ(fields.at("reset_counter"), 3);
  EXPECT_EQ(fields.at("quality"), 0);
  const double boot_s = companion.autopilot.events().front().at("boot_s");
  constexpr double kTolerance_s = 0.3;
  EXPECT_NEAR(fields.at("time_usec").get<double>() * 1e-6, toSeconds(odometry.stamp.time_since_epoch()) - boot_s,
              kTolerance_s);
  // MAVSDK answers the autopilot's timesync as if our clock were the autopilot's: an offset of about nothing.
  const auto answer = [&]() -> std::optional<json> {
    for (const json& message : companion.autopilot.messages("TIMESYNC")) {
      if (message.at("fields").at("tc1") != 0) return message.at("fields");
    }
    return std::nullopt;
  };
  ASSERT_TRUE(companion.until([&] { return answer().has_value(); }));
  EXPECT_NEAR(answer()->at("tc1").get<double>() * 1e-9, answer()->at("ts1").get<double>() * 1e-9, kTolerance_s);
}

TEST(Link, CarriesHowWrongOdometryIs) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  const OdometrySpread spread{.position_sd_m = 0.5, .attitude_sd_rad = 0.25, .velocity_sd_m_s = 2.0};
  VioOdometry odometry;
  odometry.stamp = monotonicNow();
  odometry.velocity_W_m_s = Vec3(1.0, 0.0, 0.0);
  odometry.pose_covariance_W = poseCovariance(spread);
  odometry.velocity_covariance_B = velocityCovariance(spread);
  ASSERT_EQ(companion.link.send(toFrd(odometry)), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("ODOMETRY"));
  const json fields = companion.autopilot.messages("ODOMETRY").front().at("fields");
  for (const std::size_t x_y_z : {0U, 6U, 11U}) {
    EXPECT_EQ(fields.at("pose_covariance").at(x_y_z), 0.25);
    EXPECT_EQ(fields.at("velocity_covariance").at(x_y_z), 4.0);
  }
  for (const std::size_t roll_pitch_yaw : {15U, 18U, 20U}) {
    EXPECT_EQ(fields.at("pose_covariance").at(roll_pitch_yaw), 0.0625);
    EXPECT_TRUE(fields.at("velocity_covariance").at(roll_pitch_yaw).is_null());
  }
  EXPECT_EQ(fields.at("pose_covariance").at(1), 0.0);
}

TEST(Link, CarriesStatusTexts) {
  Companion companion(Wire::kUdp);
  ASSERT_TRUE(companion.untilLinked());
  ASSERT_EQ(companion.link.sendText(Severity::kWarning, "NanoMap: braking, no depth image for 0.2 s"),
            SendResult::kSent);
  ASSERT_EQ(companion.link.sendText(Severity::kInfo, std::string(60, 'x')), SendResult::kSent);
  ASSERT_TRUE(companion.untilReceived("STATUSTEXT", 3));
  const auto texts = companion.autopilot.messages("STATUSTEXT");
  EXPECT_EQ(texts[0].at("fields").at("severity"), 4);
  EXPECT_EQ(texts[0].at("fields").at("text"), "NanoMap: braking, no depth image for 0.2 s");
  EXPECT_EQ(texts[0].at("fields").at("id"), 0);
  EXPECT_EQ(texts[1].at("fields").at("text"), std::string(50, 'x'));
  EXPECT_EQ(texts[2].at("fields").at("text"), std::string(10, 'x'));
  EXPECT_EQ(texts[1].at("fields").at("id"), texts[2].at("fields").at("id"));
  EXPECT_EQ(texts[2].at("fields").at("chunk_seq"), 1);
}

TEST(Link, FeedsTheAlignment) {
  Companion companion(Wire::kUdp);
  AlignmentEstimator estimator{AlignmentParameters{}};
  // The autopilot stands at its origin and faces north; the VIO has it elsewhere.
  BodyPose pose;
  pose.T_W_B = {Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), Vec3(4.0, 0.0, 1.0)};
  const auto aligned = [&](double heading_rad, const Vec3& vehicle_NED) {
    pose.stamp = monotonicNow();
    estimator.addWorldPose(pose);
    while (const auto autopilot = companion.link.takePose()) estimator.addAutopilotPose(*autopilot);
    const Alignment alignment = estimator.alignment(pose.stamp);
    return alignment.verdict == AlignmentVerdict::kGood &&
           std::abs(wrapAngle(alignment.T_NED_W->heading_rad() - heading_rad)) < 0.01 &&
           (alignment.T_NED_W->point(pose.T_W_B.translation_m) - vehicle_NED).norm() < 0.01;
  };
  ASSERT_TRUE(companion.until([&] { return aligned(0.5, Vec3::Zero()); }));
  companion.autopilot.order("shift 10 -5 2 1.2");
  ASSERT_TRUE(companion.until([&] { return aligned(1.7, Vec3(10.0, -5.0, 2.0)); }));
  EXPECT_EQ(estimator.alignment(pose.stamp).jumps, 1U);
}

TEST(Link, NamesAUrlThatCannotBeOpened) {
  const auto messageOf = [](LinkParameters parameters) -> std::string {
    try {
      const MavlinkLink link(parameters, monotonicNow);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const MavsdkLog quiet([](MavsdkLog::Level, std::string_view) {});
  EXPECT_THAT(messageOf({.url = "no url"}), HasSubstr("'no url'"));
  EXPECT_THAT(messageOf({.url = "serial:///dev/nothing_here:57600"}), HasSubstr("/dev/nothing_here"));
  const UdpPort taken;
  EXPECT_THAT(messageOf({.url = "udpin://127.0.0.1:" + std::to_string(taken.number())}), HasSubstr("port is taken"));
  EXPECT_THAT(messageOf({.component_id = 1}), HasSubstr("component_id"));
  EXPECT_THAT(messageOf({.pose_rate_hz = 0.0}), HasSubstr("pose_rate_hz"));
}

}  // namespace
}  // namespace nanomap::test
