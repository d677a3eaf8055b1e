#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "firmware_app/configuration/load.h"
#include "tools/generate/paper_camera.h"
#include "tools/sim/planned_flyer.h"

namespace nanomap::sim {
namespace {

/// A flight of the planner in simulated time, with everything between depth image and motor in the loop.
struct Flown {
  generate::SensedFlightSummary sensed;
  PlannedFlightSummary planned;
  std::string log;
};

class PlannedFlight : public testing::Test {
 protected:
  ~PlannedFlight() override { std::filesystem::remove(file_); }

  Flown fly(const std::string& scene, Duration duration, const std::vector<std::string>& overrides = {},
            const SensorFaultPlanParameters& faults = {}) {
    constexpr int kWidth_px = 160;  // half the paper's: a quarter of the time
    constexpr int kHeight_px = 120;
    generate::SensedFlightOptions options;
    options.scene = scene;
    options.camera = generate::paperCamera(kWidth_px, kHeight_px);
    options.vio.drift = {.horizontal_std_m = 0.2, .vertical_std_m = 0.2};
    const generate::SensedFlight flight(options);
    const Configuration configuration = loadConfiguration("", overrides);
    LogWriter log(file_);
    PlannedFlyer flyer(configuration, flight.scene(), generate::SensedFlight::kStart, {}, faults, log);
    Flown flown;
    flown.sensed = flight.fly(configuration.lcm, generate::SensedFlight::kStart, duration, flyer);
    log.close();
    flown.planned = flyer.summary();
    std::ifstream file(file_, std::ios::binary);
    flown.log = {std::istreambuf_iterator<char>(file), {}};
    return flown;
  }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("planned_flight_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".lcmlog");
};

TEST_F(PlannedFlight, ThreadsTheAisleOfAWarehouseToTheGoal) {
  const Flown flown = fly("warehouse", std::chrono::seconds(40));
  EXPECT_EQ(flown.planned.outcome, Outcome::kAtGoal);
  EXPECT_GE(flown.planned.min_clearance_m, 0.4) << "the sphere of the vehicle's radius touches nothing";
  EXPECT_GT(flown.planned.top_speed_m_s, 6.0);
  EXPECT_EQ(flown.planned.plans.flownWithoutBrake(), 0U);
  const double rms_m =
      std::sqrt(flown.planned.tracking.square_sum_m2 / static_cast<double>(flown.planned.tracking.count));
  // What the default deviation says at 6 m/s, in three dimensions.
  EXPECT_LT(rms_m, std::sqrt(2.0) * (0.05 + 0.012 * 6.0)) << "the deviation that plans allow for covers it";
}

TEST_F(PlannedFlight, TheSameOptionsFlyTheSameFlight) {
  const Duration duration = std::chrono::seconds(2);
  EXPECT_TRUE(fly("forest", duration).log == fly("forest", duration).log);
}

/// Without the obstacle term the scene is a crash: else the flights above would prove nothing.
TEST_F(PlannedFlight, BlindToObstaclesItCrashes) {
  const Flown flown = fly(
      "forest", std::chrono::seconds(40),
      {"planner.stop_check=\"paper\"", "risk.max_risk=1", "vehicle.radius_m=0.01", "risk.horizontal_base_m=0",
       "risk.horizontal_per_speed_s=0", "risk.horizontal_per_time_m_s=0", "risk.vertical_base_m=0",
       "risk.vertical_per_speed_s=0", "risk.vertical_per_time_m_s=0", "risk.prior_occluded=0", "risk.prior_partial=0",
       "risk.prior_hole=0", "risk.prior_outside_fov=0", "risk.prior_beyond_range=0", "risk.prior_behind=0"});
  EXPECT_EQ(flown.planned.outcome, Outcome::kCollision);
}

}  // namespace
}  // namespace nanomap::sim
