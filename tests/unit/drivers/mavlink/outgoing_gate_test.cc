#include "drivers/mavlink/outgoing_gate.h"

#include <gtest/gtest.h>

#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/setpoint.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Time kStamp = Time(4'294'967'200ms);  // its age is told across the wrap of 32 bits

GateVerdict setpointAfter(Duration age) {
  LocalNedTarget target;
  target.time_boot_ms = bootMilliseconds(kStamp);
  return judgeOutgoing("SET_POSITION_TARGET_LOCAL_NED", toJson(target, {}), true, kStamp + age);
}

TEST(OutgoingGate, LetsFreshSetpointsPassAndNoOthers) {
  EXPECT_EQ(setpointAfter(0ms), GateVerdict::kPass);
  EXPECT_EQ(setpointAfter(200ms), GateVerdict::kPass);
  EXPECT_EQ(setpointAfter(201ms), GateVerdict::kStaleSetpoint);
  EXPECT_EQ(setpointAfter(1h), GateVerdict::kStaleSetpoint);
  EXPECT_EQ(setpointAfter(-201ms), GateVerdict::kStaleSetpoint);  // nobody knows how old it is
  EXPECT_EQ(judgeOutgoing("SET_POSITION_TARGET_LOCAL_NED", "{}", true, kStamp), GateVerdict::kStaleSetpoint);
}

TEST(OutgoingGate, DropsMavsdksHeartbeatOnceWeSendOurs) {
  const std::string mavsdks = R"({"system_status":0,"type":18})";
  EXPECT_EQ(judgeOutgoing("HEARTBEAT", mavsdks, false, kStamp), GateVerdict::kPass);
  EXPECT_EQ(judgeOutgoing("HEARTBEAT", mavsdks, true, kStamp), GateVerdict::kForeignHeartbeat);
  EXPECT_EQ(judgeOutgoing("HEARTBEAT", toJson(SystemStatus::kBoot), true, kStamp), GateVerdict::kPass);
}

TEST(OutgoingGate, LetsEverythingElsePass) {
  EXPECT_EQ(judgeOutgoing("TIMESYNC", "{}", true, kStamp), GateVerdict::kPass);
  EXPECT_EQ(judgeOutgoing("COMMAND_LONG", "no json", true, kStamp), GateVerdict::kPass);
}

}  // namespace
}  // namespace nanomap
