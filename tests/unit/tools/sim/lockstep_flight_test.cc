#include "tools/sim/lockstep_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/load.h"
#include "tools/generate/paper_camera.h"
#include "tools/replay/log_files.h"
#include "tools/replay/replay.h"
#include "tools/sim/blindness.h"

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;

/// A flight in simulated time, with everything between depth image and motor in the loop.
class LockstepFlightTest : public testing::Test {
 protected:
  ~LockstepFlightTest() override { std::filesystem::remove_all(folder_); }

  LockstepFlight fly(const std::string& scene, Duration duration, const SensorFaultPlanParameters& faults = {},
                     const std::optional<std::filesystem::path>& recordings = std::nullopt) {
    constexpr int kWidth_px = 160;  // half the paper's: a quarter of the time
    constexpr int kHeight_px = 120;
    options_.scene = scene;
    options_.camera = generate::paperCamera(kWidth_px, kHeight_px);
    return flyInLockstep(loadConfiguration("", overrides_), generate::SensedFlight(options_), duration, faults,
                         recordings);
  }

  std::map<std::string, std::string> record(const std::string& scene, Duration duration) {
    std::filesystem::remove_all(folder_);
    (void)fly(scene, duration, {}, folder_);
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      std::ifstream file(entry.path(), std::ios::binary);
      files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
    }
    return files;
  }

  generate::SensedFlightOptions options_;
  std::vector<std::string> overrides_;
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("lockstep_flight_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(LockstepFlightTest, ThreadsTheAisleOfAWarehouseToTheGoal) {
  const LockstepSummary flown = fly("warehouse", 40s).flown;
  EXPECT_EQ(flown.outcome, Outcome::kAtGoal);
  EXPECT_GE(flown.min_clearance_m, 0.4) << "the sphere of the vehicle's radius touches nothing";
  EXPECT_GT(flown.top_speed_m_s, 5.0);
  EXPECT_EQ(flown.plans.flownWithoutBrake(), 0U);
  EXPECT_EQ(flown.braked, 0U);
  EXPECT_EQ(flown.failsafes, 0U);
}

/// Drift comes on top: the autopilot flies by an estimate of its own, and T_NED_W follows the drift late.
TEST_F(LockstepFlightTest, TheDeviationThatPlansAllowForCoversHowFarTheVehicleStrays) {
  options_.vio.drift = {.horizontal_std_m = 0.0, .vertical_std_m = 0.0};
  const RiskParameters risk;
  constexpr double kSpeed_m_s = 6.0;
  const double horizontal_m = risk.horizontal.at(kSpeed_m_s, 0.0);
  const double vertical_m = risk.vertical.at(kSpeed_m_s, 0.0);
  EXPECT_LT(fly("warehouse", 40s).flown.tracking.rms_m(),
            std::sqrt(2.0 * horizontal_m * horizontal_m + vertical_m * vertical_m));
}

TEST_F(LockstepFlightTest, TheSameOptionsRecordTheSameBytes) {
  const auto first = record("forest", 3s);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(record("forest", 3s) == first);
}

TEST_F(LockstepFlightTest, IsReplayedToTheSameDecisions) {
  (void)fly("forest", 5s, {}, folder_);
  LogReader log(logFiles({folder_.string()}));
  const Configuration configuration = loadConfiguration("", overrides_);
  const auto replayed = folder_ / "decisions.lcmlog";
  LogWriter decisions(replayed);
  (void)replay(log, configuration, {}, {.decisions = &decisions});
  decisions.close();
  const auto messagesOf = [&](LogReader& reader) {
    std::vector<std::pair<Time, std::vector<std::uint8_t>>> messages;
    for (const LogEvent& event : reader.events()) {
      if (reader.channelOf(event) != configuration.lcm.decisions_channel) continue;
      reader.read(event, messages.emplace_back(event.log_stamp, std::vector<std::uint8_t>()).second);
    }
    return messages;
  };
  LogReader again(replayed);
  const auto recorded = messagesOf(log);
  EXPECT_GT(recorded.size(), 100U);
  EXPECT_TRUE(messagesOf(again) == recorded);
}

/// Without the obstacle term the scene is a crash: else the flights above would prove nothing.
TEST_F(LockstepFlightTest, BlindToObstaclesItCrashes) {
  overrides_ = blindToObstacles();
  EXPECT_EQ(fly("forest", 40s).flown.outcome, Outcome::kCollision);
}

/// A hundredth of the way in every direction, corrected once a second.
TEST_F(LockstepFlightTest, DriftIsFlownThroughToTheGoal) {
  constexpr double kMetresIn5s = 0.35;  // at 7 m/s
  options_.vio.drift = {.horizontal_std_m = kMetresIn5s, .vertical_std_m = kMetresIn5s};
  options_.correction_hz = 1.0;
  const LockstepSummary flown = fly("warehouse", 40s).flown;
  EXPECT_EQ(flown.outcome, Outcome::kAtGoal);
}

TEST_F(LockstepFlightTest, AJumpOfTheEstimatorsWorldIsBrakedForAndFlownOn) {
  const LockstepSummary flown = fly("warehouse", 60s, {.camera = {}, .estimator = {}, .jump = Jump{2s, 1.0}}).flown;
  EXPECT_NE(flown.outcome, Outcome::kCollision);
  EXPECT_GE(flown.braked, 1U);
  EXPECT_EQ(flown.failsafes, 0U);
}

TEST_F(LockstepFlightTest, ACameraThatIsAwayForASecondIsBrakedForAndFlownOn) {
  const LockstepSummary flown = fly("warehouse", 60s, {.camera = Outage{2s, 1s}, .estimator = {}, .jump = {}}).flown;
  EXPECT_EQ(flown.outcome, Outcome::kAtGoal);
  EXPECT_EQ(flown.braked, 1U);
  EXPECT_EQ(flown.failsafes, 0U);
}

}  // namespace
}  // namespace nanomap::sim
