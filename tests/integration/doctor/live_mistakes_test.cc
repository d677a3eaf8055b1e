#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <stdexcept>

#include "firmware_app/configuration/load.h"
#include "firmware_app/flight/process_clock.h"
#include "tests/integration/doctor/findings.h"
#include "tests/integration/doctor/live_vehicle.h"
#include "tests/integration/doctor/recorded_flight.h"
#include "tests/integration/lcm/network.h"
#include "tests/integration/mavlink/autopilot_process.h"
#include "tools/doctor/gather_live.h"

namespace nanomap::test {
namespace {

using namespace std::chrono_literals;
using doctor::Facts;
using doctor::Findings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Duration kListen = 4s;
constexpr std::uint8_t kComponentId = 194;

/// A machine that grants all that is needed: the one that runs this test may not.
void makeMachineHealthy(Facts& facts) {
  facts.machine = doctor::MachineFacts{};
  facts.machine->realtime.cores = {0, 1, 2, 3};
  facts.machine->realtime.tried_priority = 45;
  facts.machine->realtime.may_schedule = true;
  facts.machine->realtime.may_lock_memory = true;
  facts.receive_buffer =
      doctor::ReceiveBuffer{.wanted_bytes = 2'097'152, .granted_bytes = 2'097'152, .limit_bytes = 2'097'152};
}

/// A vehicle that lives: its messages over LCM, its autopilot over MAVLink.
class LiveMistakeTest : public MulticastTest {
 protected:
  void SetUp() override {
    MulticastTest::SetUp();
    (void)healthyFlight();  // takes its time
  }

  [[nodiscard]] Facts gather(const std::vector<std::string>& autopilot_arguments = {},
                             const std::vector<std::string>& overrides = {}, Duration ahead = {}) {
    std::vector<std::string> arguments = {"--udp", std::to_string(UdpPort().number()), "--altitude", "2"};
    arguments.insert(arguments.end(), autopilot_arguments.begin(), autopilot_arguments.end());
    AutopilotProcess autopilot(arguments);
    const LiveVehicle vehicle(url(), ahead);
    std::vector<std::string> all = {"lcm.url=" + url(), "mavlink.url=" + autopilot.url()};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Facts facts;
    facts.configuration = loadConfiguration({}, all);
    doctor::gatherLive(facts, kComponentId, kListen);
    autopilot.read(0ms);
    for (const nlohmann::json& heartbeat : autopilot.messages("HEARTBEAT"))
      speakers_.insert(heartbeat.at("component").get<int>());
    makeMachineHealthy(facts);
    return facts;
  }

  std::set<int> speakers_;  ///< components that the autopilot was spoken to by
};

TEST_F(LiveMistakeTest, HealthyVehicleIsFoundHealthyAndMachinesLimitsAreNamed) {
  Facts facts = gather();
  const Findings healthy = diagnose(facts);
  EXPECT_THAT(failed(healthy), IsEmpty()) << toText(healthy);
  EXPECT_THAT(speakers_, ElementsAre(kComponentId)) << "the autopilot must not take it for the flight process";
  EXPECT_EQ(facts.autopilot->parameters.size(), 4U);
  for (const auto& [name, value] : facts.autopilot->parameters) EXPECT_TRUE(value) << name;

  facts.receive_buffer->limit_bytes = 212'992;
  facts.receive_buffer->granted_bytes = 212'992;
  const Findings buffer = diagnose(facts);
  EXPECT_THAT(failed(buffer), ElementsAre("receive buffer")) << toText(buffer);
  EXPECT_THAT(fixOf(buffer, "receive buffer"), HasSubstr("sysctl -w net.core.rmem_max=2097152"));

  makeMachineHealthy(facts);
  facts.machine->realtime.fifo_error = EPERM;
  facts.machine->realtime.may_schedule = false;
  const Findings realtime = diagnose(facts);
  EXPECT_THAT(failed(realtime), ElementsAre("real time")) << toText(realtime);
  EXPECT_THAT(fixOf(realtime, "real time"), HasSubstr("LimitRTPRIO"));
}

TEST_F(LiveMistakeTest, StampsOfTheOtherClockAreNamed) {
  const Findings realtime = diagnose(gather({}, {}, realtimeAhead()));
  EXPECT_THAT(failed(realtime), ElementsAre("clock")) << toText(realtime);
  EXPECT_THAT(fixOf(realtime, "clock"), HasSubstr("lcm.clock = \"realtime\""));
  const Findings monotonic = diagnose(gather({}, {"lcm.clock=realtime"}));
  EXPECT_THAT(failed(monotonic), ElementsAre("clock")) << toText(monotonic);
  EXPECT_THAT(fixOf(monotonic, "clock"), HasSubstr("lcm.clock = \"monotonic\""));
}

TEST_F(LiveMistakeTest, ItsComponentIsNotThatOfTheFlightProcess) {
  EXPECT_THROW((void)gather({}, {"mavlink.component_id=" + std::to_string(kComponentId)}), std::invalid_argument);
}

TEST_F(LiveMistakeTest, AutopilotElsewhereIsNamed) {
  const std::string wrong = "udpin://127.0.0.1:" + std::to_string(UdpPort().number());
  const Findings findings = diagnose(gather({}, {"mavlink.url=" + wrong}));
  EXPECT_THAT(failed(findings), ElementsAre("autopilot")) << toText(findings);
  EXPECT_THAT(fixOf(findings, "autopilot"), HasSubstr("mavlink.url"));
}

TEST_F(LiveMistakeTest, PortThatAnotherProcessHasIsSaid) {
  const UdpPort taken;
  const Findings findings = diagnose(gather({}, {"mavlink.url=udpin://127.0.0.1:" + std::to_string(taken.number())}));
  EXPECT_THAT(failed(findings), ElementsAre("autopilot")) << toText(findings);
  EXPECT_THAT(fixOf(findings, "autopilot"), HasSubstr("the port is taken"));
}

struct Setting {
  std::string name;
  std::string value;
  std::vector<std::string> overrides;
};

class AutopilotSetting : public LiveMistakeTest, public ::testing::WithParamInterface<Setting> {};

TEST_P(AutopilotSetting, ThatIsUnsafeIsNamed) {
  const Setting& setting = GetParam();
  const Findings findings = diagnose(gather({"--param", setting.name + "=" + setting.value}, setting.overrides));
  EXPECT_THAT(failed(findings), ElementsAre(setting.name)) << toText(findings);
  EXPECT_THAT(fixOf(findings, setting.name), HasSubstr("set " + setting.name + " = "));
}

INSTANTIATE_TEST_SUITE_P(Px4, AutopilotSetting,
                         ::testing::Values(Setting{"COM_OBL_RC_ACT", "0", {}}, Setting{"COM_OF_LOSS_T", "10", {}},
                                           Setting{"COM_OF_LOSS_T", "0.1", {}},
                                           Setting{"EKF2_EV_CTRL", "0", {"mavlink.send_odometry=true"}}),
                         [](const auto& setting) { return setting.param.name + "_" + std::to_string(setting.index); });

TEST_F(LiveMistakeTest, ArduPilotTellsItsOwnParameters) {
  const Findings healthy = diagnose(gather({"--rules", "ardupilot", "--loss", "1"}));
  EXPECT_THAT(failed(healthy), IsEmpty()) << toText(healthy);
  const auto told = [&](const std::string& name) {
    return std::ranges::any_of(healthy, [&](const doctor::Finding& finding) {
      return finding.subject == name && finding.verdict != doctor::Verdict::kNotLookedAt;
    });
  };
  for (const std::string& name : doctor::parametersOf(AutopilotKind::kArduPilot)) EXPECT_TRUE(told(name)) << name;
  const Findings unused = diagnose(
      gather({"--rules", "ardupilot", "--loss", "1", "--param", "VISO_TYPE=1"}, {"mavlink.send_odometry=true"}));
  EXPECT_THAT(failed(unused), ElementsAre("EK3_SRC1_POSXY")) << toText(unused);
}

}  // namespace
}  // namespace nanomap::test
