#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "tests/unit/tools/doctor/vehicle.h"

namespace nanomap::doctor {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

MachineFacts healthyMachine() {
  MachineFacts machine;
  machine.realtime.cores = {0, 1};
  machine.realtime.may_lock_memory = true;
  return machine;
}

Facts withAutopilot(AutopilotKind kind) {
  Facts facts = healthyFacts();
  AutopilotFacts& autopilot = facts.autopilot.emplace();
  autopilot.state = {.kind = kind, .heartbeat_age = 100ms, .position_age = 10ms, .attitude_age = 10ms, .linked = true};
  return facts;
}

/// What is made of one value of one parameter.
Verdict judged(AutopilotKind kind, const std::string& name, double value, bool send_odometry = false) {
  Facts facts = withAutopilot(kind);
  facts.configuration.mavlink.send_odometry = send_odometry;
  facts.autopilot->parameters[name] = value;
  for (const Finding& finding : checkParameters(facts)) {
    if (finding.subject == name) return finding.verdict;
  }
  ADD_FAILURE() << name << " is not asked for";
  return Verdict::kNotLookedAt;
}

TEST(ParametersCheck, LossTimeoutIsNeitherLongNorShort) {
  constexpr AutopilotKind kPx4 = AutopilotKind::kPx4;
  for (const double good_s : {0.5, 1.0, 1.5}) EXPECT_EQ(judged(kPx4, "COM_OF_LOSS_T", good_s), Verdict::kOk) << good_s;
  for (const double bad_s : {0.0, 0.4, 1.6, 60.0}) {
    EXPECT_EQ(judged(kPx4, "COM_OF_LOSS_T", bad_s), Verdict::kFailure) << bad_s;
  }
  EXPECT_EQ(judged(AutopilotKind::kArduPilot, "GUID_TIMEOUT", 5.0), Verdict::kFailure);
}

TEST(ParametersCheck, LossActionThatNeedsAPilotOrFallsFails) {
  constexpr AutopilotKind kPx4 = AutopilotKind::kPx4;
  for (const int bad : {-1, 0, 1, 2, 6, 7}) EXPECT_EQ(judged(kPx4, "COM_OBL_RC_ACT", bad), Verdict::kFailure) << bad;
  EXPECT_EQ(judged(kPx4, "COM_OBL_RC_ACT", 3), Verdict::kWarning);
  for (const int good : {4, 5}) EXPECT_EQ(judged(kPx4, "COM_OBL_RC_ACT", good), Verdict::kOk) << good;
}

TEST(ParametersCheck, VisionIsUsedIfAndOnlyIfItIsSent) {
  constexpr AutopilotKind kPx4 = AutopilotKind::kPx4;
  EXPECT_EQ(judged(kPx4, "EKF2_EV_CTRL", 0, true), Verdict::kFailure);
  EXPECT_EQ(judged(kPx4, "EKF2_EV_CTRL", 4, true), Verdict::kWarning);
  EXPECT_EQ(judged(kPx4, "EKF2_EV_CTRL", 15, true), Verdict::kOk);
  EXPECT_EQ(judged(kPx4, "EKF2_EV_CTRL", 0), Verdict::kOk);
  EXPECT_EQ(judged(kPx4, "EKF2_EV_CTRL", 15), Verdict::kWarning);
  EXPECT_EQ(judged(kPx4, "EKF2_EV_DELAY", 200, true), Verdict::kWarning);
}

struct Source {
  std::string name;
  Verdict gps, none, barometer, external;  ///< what is made of it while our poses are sent
};

TEST(ParametersCheck, SourcesOfArduPilotAreOursOrDoNotContradict) {
  constexpr AutopilotKind kArduPilot = AutopilotKind::kArduPilot;
  constexpr Verdict kOk = Verdict::kOk, kWarning = Verdict::kWarning, kFailure = Verdict::kFailure;
  for (const Source& source :
       {Source{"EK3_SRC1_POSXY", kFailure, kFailure, kFailure, kOk},
        Source{"EK3_SRC1_VELXY", kWarning, kOk, kWarning, kOk}, Source{"EK3_SRC1_POSZ", kWarning, kWarning, kOk, kOk},
        Source{"EK3_SRC1_VELZ", kWarning, kOk, kWarning, kOk}}) {
    EXPECT_EQ(judged(kArduPilot, source.name, 3, true), source.gps) << source.name;
    EXPECT_EQ(judged(kArduPilot, source.name, 0, true), source.none) << source.name;
    EXPECT_EQ(judged(kArduPilot, source.name, 1, true), source.barometer) << source.name;
    EXPECT_EQ(judged(kArduPilot, source.name, 6, true), source.external) << source.name;
    EXPECT_EQ(judged(kArduPilot, source.name, 3), kOk) << source.name;
    EXPECT_EQ(judged(kArduPilot, source.name, 6), kWarning) << source.name << ": nobody sends it";
  }
  EXPECT_EQ(judged(kArduPilot, "EK3_SRC1_YAW", 6), kWarning);
  for (const int type : {1, 2, 3}) EXPECT_EQ(judged(kArduPilot, "VISO_TYPE", type, true), kOk) << type;
  for (const int type : {0, 4}) EXPECT_EQ(judged(kArduPilot, "VISO_TYPE", type, true), kFailure) << type;
  EXPECT_EQ(judged(kArduPilot, "VISO_TYPE", 0), kOk);
}

TEST(ParametersCheck, HeadingOfArduPilotIsThatOfThePositionsItFliesBy) {
  const auto failures = [](double position, double vision_type, double yaw) {
    Facts facts = withAutopilot(AutopilotKind::kArduPilot);
    facts.configuration.mavlink.send_odometry = true;
    facts.autopilot->parameters = {{"EK3_SRC1_POSXY", position}, {"VISO_TYPE", vision_type}, {"EK3_SRC1_YAW", yaw}};
    return fixesOf(checkParameters(facts));
  };
  constexpr const char* kFix = "set EK3_SRC1_YAW = 6";
  EXPECT_THAT(failures(6, 1, 1), HasSubstr(kFix)) << "compass, and poses as they come";
  EXPECT_THAT(failures(6, 1, 6), Not(HasSubstr(kFix)));
  EXPECT_THAT(failures(6, 3, 1), Not(HasSubstr(kFix))) << "turned to the compass";
  EXPECT_THAT(failures(3, 1, 1), Not(HasSubstr(kFix))) << "our positions are not used: that is the mistake";
}

TEST(ParametersCheck, WhatTheAutopilotDoesNotTellIsNotLookedAt) {
  EXPECT_EQ(verdictOf(checkParameters(withAutopilot(AutopilotKind::kPx4))), Verdict::kNotLookedAt);
  EXPECT_TRUE(checkParameters(withAutopilot(AutopilotKind::kOther)).empty());
}

TEST(AutopilotCheck, EachStageOfTheLinkIsTold) {
  EXPECT_EQ(verdictOf(checkAutopilot(withAutopilot(AutopilotKind::kPx4))), Verdict::kOk);
  EXPECT_EQ(verdictOf(checkAutopilot(withAutopilot(AutopilotKind::kOther))), Verdict::kFailure);

  Facts facts = withAutopilot(AutopilotKind::kArduPilot);
  facts.autopilot->other_system = 3;
  facts.configuration.mavlink.send_odometry = facts.configuration.mavlink.send_obstacles = false;
  EXPECT_EQ(verdictOf(checkAutopilot(facts)), Verdict::kWarning);
  facts.configuration.mavlink.send_odometry = true;
  EXPECT_EQ(verdictOf(checkAutopilot(facts)), Verdict::kFailure);
  EXPECT_THAT(fixesOf(checkAutopilot(facts)), HasSubstr("a port or a line of its own"));
  facts.autopilot->other_system.reset();
  facts.autopilot->state.position_age.reset();
  EXPECT_EQ(verdictOf(checkAutopilot(facts)), Verdict::kFailure);
  facts.autopilot->state.linked = false;
  EXPECT_THAT(checkAutopilot(facts)[0].seen, HasSubstr("0.1 s old"));
  facts.autopilot->state = {};
  EXPECT_THAT(checkAutopilot(facts)[0].seen, HasSubstr("no heartbeat"));
  facts.autopilot->other_system = 3;
  EXPECT_EQ(verdictOf(checkAutopilot(facts)), Verdict::kFailure);
  EXPECT_THAT(fixesOf(checkAutopilot(facts)), HasSubstr("mavlink.system_id = 3"));
}

TEST(AutopilotCheck, PortOfTheFlightProcessIsNoFailure) {
  Facts facts = healthyFacts();
  AutopilotFacts& autopilot = facts.autopilot.emplace();
  autopilot.fault = "the port is taken";
  autopilot.port_taken = true;
  EXPECT_EQ(verdictOf(checkAutopilot(facts)), Verdict::kFailure);
  facts.heard->health = HeardHealth{"waiting", "depth images"};
  const Findings findings = checkAutopilot(facts);
  EXPECT_EQ(verdictOf(findings), Verdict::kNotLookedAt);
  EXPECT_THAT(findings[0].seen, HasSubstr("waiting, depth images"));
}

TEST(NetworkCheck, BufferIsWhatWasWantedUnlessTheLimitIsSmaller) {
  Facts facts = healthyFacts();
  facts.receive_buffer = ReceiveBuffer{.wanted_bytes = 1000, .granted_bytes = 1000, .limit_bytes = 1000};
  EXPECT_EQ(verdictOf(checkNetwork(facts)), Verdict::kOk);
  facts.receive_buffer->lost = 3;
  EXPECT_EQ(verdictOf(checkNetwork(facts)), Verdict::kWarning);
  facts.receive_buffer->limit_bytes = 999;
  EXPECT_EQ(verdictOf(checkNetwork(facts)), Verdict::kFailure);
  EXPECT_THAT(fixesOf(checkNetwork(facts)), HasSubstr("net.core.rmem_max=1000"));
}

TEST(NetworkCheck, WhatLeavesTheMachineIsSaid) {
  Facts facts;
  facts.configuration.lcm.url = "udpm://239.255.76.67:7667?ttl=1";
  EXPECT_EQ(verdictOf(checkNetwork(facts)), Verdict::kWarning);
  facts.lcm_fault = "no route for multicast";
  EXPECT_EQ(verdictOf(checkNetwork(facts)), Verdict::kFailure);
}

TEST(RealtimeCheck, EachRefusalFails) {
  MachineFacts machine = healthyMachine();
  EXPECT_EQ(verdictOf(checkRealtime(machine)), Verdict::kOk);
  machine.realtime.fifo_error = EPERM;
  machine.layout_fault = "realtime.planner_core = 7: the cores are 0, 1";
  EXPECT_EQ(checkRealtime(machine).size(), 2U);
  EXPECT_EQ(verdictOf(checkRealtime(machine)), Verdict::kFailure);
}

TEST(DevicesCheck, IsNeverMoreThanAList) {
  MachineFacts machine = healthyMachine();
  machine.video = {{"/dev/video0", true}, {"/dev/video2", false}};
  const Findings findings = checkDevices(machine);
  EXPECT_EQ(verdictOf(findings), Verdict::kNotLookedAt);
  EXPECT_THAT(findings[0].seen, HasSubstr("/dev/video0, /dev/video2 (may not be opened"));
}

TEST(DiskCheck, RoomIsJudgedWithWhatIsRecordedAlready) {
  const RecorderParameters recorder{.segment_mb = 10, .total_mb = 100};
  MachineFacts machine = healthyMachine();
  EXPECT_EQ(verdictOf(checkDisk(machine, recorder)), Verdict::kNotLookedAt);
  constexpr std::uint64_t kMegabyte = 1'000'000;
  machine.disk =
      Disk{.folder = "flights", .writable = true, .free_bytes = 30 * kMegabyte, .recorded_bytes = 70 * kMegabyte};
  EXPECT_EQ(verdictOf(checkDisk(machine, recorder)), Verdict::kOk);
  machine.disk->recorded_bytes = 69 * kMegabyte;
  EXPECT_EQ(verdictOf(checkDisk(machine, recorder)), Verdict::kWarning);
  machine.disk->free_bytes = 19 * kMegabyte;
  EXPECT_EQ(verdictOf(checkDisk(machine, recorder)), Verdict::kFailure);
  machine.disk->writable = false;
  EXPECT_THAT(fixesOf(checkDisk(machine, recorder)), HasSubstr("mkdir -p flights"));
}

TEST(ConfigurationCheck, DefaultsRaiseNoSuspicion) {
  EXPECT_EQ(verdictOf(checkConfiguration(Facts{})), Verdict::kOk);
  Facts facts;
  facts.configuration.camera = test::smallCamera();
  EXPECT_EQ(verdictOf(checkConfiguration(facts)), Verdict::kOk);
}

TEST(ConfigurationCheck, LegalValuesThatNobodyWouldFlyWithAreNamed) {
  Facts facts;
  facts.configuration.planner.risk.max_risk = 0.1;
  facts.configuration.planner.risk.prior[static_cast<std::size_t>(Status::kHole)] = 0.0;
  facts.configuration.planner.stop_check = StopCheck::kPaper;
  facts.configuration.chain.drift.horizontal_std_m = 0.0;
  facts.configuration.safety.max_depth_age = 5s;
  facts.configuration.camera = test::smallCamera();
  facts.configuration.camera->cx_px = 0.0;
  EXPECT_EQ(checkConfiguration(facts).size(), 6U);
  EXPECT_EQ(verdictOf(checkConfiguration(facts)), Verdict::kWarning);
}

TEST(ConfigurationCheck, ClockOfALogIsForLogs) {
  Facts facts;
  facts.configuration.lcm.clock = ClockDomain::kLog;
  EXPECT_EQ(verdictOf(checkConfiguration(facts)), Verdict::kFailure);
  facts.heard.emplace().from_log = true;
  EXPECT_EQ(verdictOf(checkConfiguration(facts)), Verdict::kOk);
}

}  // namespace
}  // namespace nanomap::doctor
