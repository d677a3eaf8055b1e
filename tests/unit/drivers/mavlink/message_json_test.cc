#include "drivers/mavlink/message_json.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr const char* kHeartbeat =
    R"({"message_id":0,"autopilot":12,"base_mode":209,"custom_mode":393216,"mavlink_version":3,"type":2})";
constexpr const char* kPosition = R"({"time_boot_ms":4294967295,"x":1.5,"y":-2.5,"z":3,"vx":0.1,"vy":0.2,"vz":-0.3})";
constexpr const char* kAttitude =
    R"({"time_boot_ms":7,"q1":0.6,"q2":0.0,"q3":0,"q4":0.8,"rollspeed":0.5,"pitchspeed":-2,"yawspeed":1e-3})";

/// `fields` with one of them set to something else.
std::string with(const char* fields, const char* name, const json& value) {
  json object = json::parse(fields);
  object[name] = value;
  return object.dump();
}

TEST(MessageJson, ReadsHeartbeats) {
  const auto message = fromJson<HeartbeatMessage>(kHeartbeat);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->autopilot, 12);
  EXPECT_EQ(message->type, 2);
  EXPECT_EQ(message->base_mode, 209);
  EXPECT_EQ(message->custom_mode, 393216U);
}

TEST(MessageJson, ReadsPositions) {
  const auto message = fromJson<LocalPositionMessage>(kPosition);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->time_boot_ms, 4294967295U);
  EXPECT_EQ(message->position_NED_m, Vec3(1.5, -2.5, 3.0));
  EXPECT_EQ(message->velocity_NED_m_s, Vec3(0.1, 0.2, -0.3));
}

TEST(MessageJson, ReadsAttitudes) {
  const auto message = fromJson<AttitudeMessage>(kAttitude);
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->R_NED_FRD.isApprox(Quat(0.6, 0.0, 0.0, 0.8)));
  EXPECT_EQ(message->angular_rate_FRD_rad_s, Vec3(0.5, -2.0, 1e-3));
}

TEST(MessageJson, RefusesFieldsThatCannotBe) {
  for (const json& bad : {json(nullptr), json("7"), json(true), json::array({7}), json::object(), json(-1), json(7.5),
                          json(4294967296), json(1e300)}) {
    EXPECT_FALSE(fromJson<HeartbeatMessage>(with(kHeartbeat, "custom_mode", bad))) << bad;
    EXPECT_FALSE(fromJson<LocalPositionMessage>(with(kPosition, "time_boot_ms", bad))) << bad;
  }
  EXPECT_FALSE(fromJson<HeartbeatMessage>(with(kHeartbeat, "base_mode", 256)));
  EXPECT_FALSE(fromJson<LocalPositionMessage>(with(kPosition, "y", nullptr)));  // NaN
  EXPECT_FALSE(fromJson<AttitudeMessage>(with(kAttitude, "q1", 0.7)));          // no unit quaternion
  json object = json::parse(kPosition);
  object.erase("vz");
  EXPECT_FALSE(fromJson<LocalPositionMessage>(object.dump()));
}

TEST(MessageJson, RefusesWhatIsNoObject) {
  for (const std::string& text : {std::string(), std::string("{"), std::string("[]"), std::string("null"),
                                  std::string(kHeartbeat) + "x", std::string(100'000, '[')}) {
    EXPECT_FALSE(fromJson<HeartbeatMessage>(text));
  }
  EXPECT_FALSE(fromJson<HeartbeatMessage>(with(kHeartbeat, "more", std::string(10'000, 'x'))));  // too long
}

RC_GTEST_PROP(MessageJson, SurvivesDamage, ()) {
  std::string text = *rc::gen::element(std::string(kHeartbeat), std::string(kPosition), std::string(kAttitude));
  for (const auto& [at, byte] : *rc::gen::container<std::vector<std::pair<std::size_t, char>>>(
           rc::gen::pair(rc::gen::inRange<std::size_t>(0, text.size()), rc::gen::arbitrary<char>()))) {
    text[at] = byte;
  }
  text.resize(*rc::gen::inRange<std::size_t>(0, text.size() + 1));
  (void)fromJson<HeartbeatMessage>(text);
  (void)fromJson<LocalPositionMessage>(text);
  if (const auto attitude = fromJson<AttitudeMessage>(text)) RC_ASSERT(attitude->R_NED_FRD.coeffs().allFinite());
  (void)fromJson<LandedStateMessage>(text);
}

TEST(MessageJson, KeepsEveryBitOfASetpoint) {
  LocalNedTarget target;
  target.time_boot_ms = 4294967295U;
  target.type_mask = 3527;
  target.position_NED_m = {1234.5679F, 1.0F / 3.0F, -1e-9F};
  target.yaw_NED_rad = 3.1415927F;
  const json fields = json::parse(toJson(target, {7, 1}));
  EXPECT_EQ(fields["time_boot_ms"], 4294967295U);
  EXPECT_EQ(fields["type_mask"], 3527);
  EXPECT_EQ(fields["coordinate_frame"], 1);
  EXPECT_EQ(fields["target_system"], 7);
  EXPECT_EQ(fields["x"].get<float>(), 1234.5679F);
  EXPECT_EQ(fields["y"].get<float>(), 1.0F / 3.0F);
  EXPECT_EQ(fields["z"].get<float>(), -1e-9F);
  EXPECT_EQ(fields["yaw"].get<float>(), 3.1415927F);
}

TEST(MessageJson, WritesNaNAsNull) {
  OdometryMessage odometry;
  odometry.pose_covariance[0] = std::numeric_limits<float>::quiet_NaN();
  odometry.velocity_m_s.x() = std::numeric_limits<float>::quiet_NaN();
  const json fields = json::parse(toJson(odometry, 7'123'456'789ns));
  EXPECT_EQ(fields["time_usec"], 7'123'456);
  EXPECT_TRUE(fields["pose_covariance"][0].is_null());
  EXPECT_EQ(fields["pose_covariance"].size(), 21U);
  EXPECT_TRUE(fields["vx"].is_null());
  EXPECT_EQ(fields["q"], json({1.0, 0.0, 0.0, 0.0}));
}

TEST(MessageJson, AsksForIntervalsInMicroseconds) {
  const json fields = json::parse(toJson(MessageIntervalRequest{32, 20ms}, {1, 1}));
  EXPECT_EQ(fields["command"], 511);
  EXPECT_EQ(fields["param1"], 32);
  EXPECT_EQ(fields["param2"], 20'000);
}

TEST(MessageJson, AsksForParametersByName) {
  const json fields = json::parse(toJson(ParameterRequest{"COM_OF_LOSS_T"}, {7, 1}));
  EXPECT_EQ(fields["param_id"], "COM_OF_LOSS_T");
  EXPECT_EQ(fields["param_index"], -1);
  EXPECT_EQ(fields["target_system"], 7);
}

TEST(MessageJson, ReadsParameters) {
  const auto message =
      fromJson<ParameterMessage>(R"({"param_id": "GUID_TIMEOUT", "param_value": 2.5, "param_type": 9})");
  ASSERT_TRUE(message);
  EXPECT_EQ(message->name, "GUID_TIMEOUT");
  EXPECT_EQ(message->value, 2.5F);
  EXPECT_EQ(message->type, 9);
  EXPECT_FALSE(fromJson<ParameterMessage>(R"({"param_id": 7, "param_value": 2.5, "param_type": 9})"));
  EXPECT_FALSE(fromJson<ParameterMessage>(R"({"param_id": "A", "param_value": null, "param_type": 9})"));
  EXPECT_FALSE(fromJson<ParameterMessage>(R"({"param_id": "A", "param_value": 2.5})"));
}

}  // namespace
}  // namespace nanomap
