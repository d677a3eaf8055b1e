#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/integration/lockstep/at_the_goal.h"
#include "tools/generate/paper_camera.h"

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;

/// What befalls the sensors befalls them in mid-flight: at 5 m/s, among the first trees.
constexpr Duration kBefalls = 4s;
constexpr Duration kForGood = 600s;

/// Through the forest with the paper's camera, by the stages of the flight process, while something is wrong.
class TroubledFlights : public testing::Test {
 protected:
  TroubledFlights() {
    options_.scene = "forest";
    options_.camera = generate::paperCamera(320, 240);
    options_.correction_hz = 2.0;
  }

  LockstepFlight fly(Duration duration, const SensorFaultPlanParameters& faults) {
    LockstepFlight flight = flyInLockstep(configuration_, generate::SensedFlight(options_), duration, faults);
    fmt::print("{}", tableOf(options_.scene, {flight}));
    return flight;
  }

  /// Without a collision, and not by creeping.
  static void expectSwiftlyAtTheGoal(const LockstepFlight& flight) {
    constexpr double kHalfOfTheUsual_m_s = 2.5;
    expectAtTheGoal(flight);
    EXPECT_GT(flight.meanSpeed_m_s(), kHalfOfTheUsual_m_s);
  }

  Configuration configuration_;
  generate::SensedFlightOptions options_;
};

/// A hundredth of the way, as the configuration knows, corrected once a second.
TEST_F(TroubledFlights, DriftOfOnePercentIsFlownThroughToTheGoal) {
  configuration_.chain.drift.horizontal_std_m = 0.35;  // in 5 s, at 7 m/s
  options_.vio.drift = configuration_.chain.drift;
  options_.correction_hz = 1.0;
  options_.seed = 4;  // drifts more than others do in so short a flight
  const LockstepFlight flight = fly(60s, {});
  expectSwiftlyAtTheGoal(flight);
  EXPECT_GT(flight.sensed.final_error_m, 0.5) << "it has not drifted";
}

TEST_F(TroubledFlights, AThirdOfEveryFrameLostInPatchesIsFlownThroughToTheGoal) {
  options_.sensor.patch_share = 1.0 / 3.0;
  const LockstepFlight flight = fly(60s, {});
  expectSwiftlyAtTheGoal(flight);
  EXPECT_LT(flight.sensed.depth_share, 0.6) << "too much of the frames is left for this to matter";
}

TEST_F(TroubledFlights, JumpOfTheEstimatorsWorldByAMetreIsBrakedForAndFlownOn) {
  const LockstepFlight flight = fly(60s, {.camera = {}, .estimator = {}, .jump = Jump{kBefalls, 1.0}});
  expectSwiftlyAtTheGoal(flight);
  EXPECT_GE(flight.flown.braked, 1U);
}

TEST_F(TroubledFlights, CameraThatIsUnpluggedForASecondIsBrakedForAndFlownOn) {
  const LockstepFlight flight = fly(60s, {.camera = Outage{kBefalls, 1s}, .estimator = {}, .jump = {}});
  expectSwiftlyAtTheGoal(flight);
  EXPECT_GE(flight.flown.braked, 1U);
}

/// It stands before it lets go, and stays clear of the trees.
TEST_F(TroubledFlights, CameraThatIsUnpluggedForGoodEndsInTheAutopilotsHands) {
  const LockstepSummary flown = fly(16s, {.camera = Outage{kBefalls, kForGood}, .estimator = {}, .jump = {}}).flown;
  EXPECT_EQ(flown.outcome, Outcome::kUnderWay);
  EXPECT_GE(flown.min_clearance_m, kVehicleRadius_m);
  EXPECT_GT(flown.top_speed_m_s, 4.0) << "too slow for the fault to matter";
  EXPECT_EQ(flown.braked, 1U);
  EXPECT_EQ(flown.failsafes, 1U);
}

}  // namespace
}  // namespace nanomap::sim
