#include "tools/sim/sensor_fault_plan.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Time kDeparture = Time(100s);

TEST(SensorFaultPlan, BefallsNobodyBeforeTheDeparture) {
  SensorFaultPlan plan({.camera = Outage{0s, 1s}, .estimator = Outage{0s, 1s}, .jump = Jump{0s, 1.0}});
  const generate::SensorFaults faults = plan.at(kDeparture, std::nullopt);
  EXPECT_FALSE(faults.camera_off);
  EXPECT_FALSE(faults.estimator_off);
  EXPECT_EQ(faults.jump_m, 0.0);
}

TEST(SensorFaultPlan, OutagesBeginAndEnd) {
  SensorFaultPlan plan({.camera = Outage{2s, 1s}, .estimator = Outage{4s, 500ms}, .jump = {}});
  EXPECT_FALSE(plan.at(kDeparture + 1999ms, kDeparture).camera_off);
  EXPECT_TRUE(plan.at(kDeparture + 2s, kDeparture).camera_off);
  EXPECT_TRUE(plan.at(kDeparture + 2999ms, kDeparture).camera_off);
  EXPECT_FALSE(plan.at(kDeparture + 2999ms, kDeparture).estimator_off);
  EXPECT_FALSE(plan.at(kDeparture + 3s, kDeparture).camera_off);
  EXPECT_TRUE(plan.at(kDeparture + 4s, kDeparture).estimator_off);
  EXPECT_FALSE(plan.at(kDeparture + 4500ms, kDeparture).estimator_off);
}

TEST(SensorFaultPlan, JumpsOnce) {
  SensorFaultPlan plan({.camera = {}, .estimator = {}, .jump = Jump{1s, 2.5}});
  EXPECT_EQ(plan.at(kDeparture, kDeparture).jump_m, 0.0);
  EXPECT_EQ(plan.at(kDeparture + 1s, kDeparture).jump_m, 2.5);
  EXPECT_EQ(plan.at(kDeparture + 1s, kDeparture).jump_m, 0.0);
  EXPECT_EQ(plan.at(kDeparture + 2s, kDeparture).jump_m, 0.0);
}

TEST(SensorFaultPlan, IsReadFromText) {
  EXPECT_EQ(parseOutage("--camera-off", "5:1.5").after, 5s);
  EXPECT_EQ(parseOutage("--camera-off", "5:1.5").lasts, 1500ms);
  EXPECT_EQ(parseJump("--vio-jump", "0:1").distance_m, 1.0);
  for (const char* text : {"", "5", "5:", ":1", "5:0", "-1:1", "5:1s", "5:1:2", "a:b", "nan:1", "1:inf"}) {
    EXPECT_THAT([&] { (void)parseOutage("--camera-off", text); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("--camera-off " + std::string(text) + ": give")));
  }
}

}  // namespace
}  // namespace nanomap::sim
