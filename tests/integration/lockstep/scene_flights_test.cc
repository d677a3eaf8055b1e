#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "firmware_app/configuration/load.h"
#include "tools/generate/paper_camera.h"
#include "tools/sim/blindness.h"
#include "tools/sim/lockstep_flight.h"

namespace nanomap::sim {
namespace {

struct Size {
  int width_px;
  int height_px;
};
constexpr Size kPapers{320, 240};
constexpr Size kSmall{160, 120};  ///< a quarter of the time

constexpr int kFew = 2;
constexpr int kTen = 10;

constexpr double kVehicleRadius_m = 0.4;

/// Whole flights through a scene, by the stages of the flight process; drift is that of an ordinary estimator.
class SceneFlights : public testing::TestWithParam<const char*> {
 protected:
  static std::vector<LockstepFlight> fly(int seeds, const Size& size, const std::vector<std::string>& overrides) {
    const Configuration configuration = loadConfiguration("", overrides);
    generate::SensedFlightOptions options;
    options.scene = GetParam();
    options.camera = generate::paperCamera(size.width_px, size.height_px);
    options.correction_hz = 2.0;
    std::vector<LockstepFlight> flights;
    for (int i = 0; i < seeds; ++i, ++options.seed) {
      flights.push_back(flyInLockstep(configuration, generate::SensedFlight(options), std::chrono::seconds(120)));
    }
    fmt::print("{}", tableOf(options.scene, flights));
    return flights;
  }

  static void expectAllAtTheGoal(const std::vector<LockstepFlight>& flights) {
    for (const auto& [seed, sensed, flown] : flights) {
      EXPECT_EQ(flown.outcome, Outcome::kAtGoal) << "seed " << seed;
      EXPECT_GE(flown.min_clearance_m, kVehicleRadius_m) << "seed " << seed;
      EXPECT_EQ(flown.plans.flownWithoutBrake(), 0U) << "seed " << seed;
      EXPECT_EQ(flown.failsafes, 0U) << "seed " << seed;
    }
  }

  static std::ptrdiff_t collisions(const std::vector<LockstepFlight>& flights) {
    return std::ranges::count_if(
        flights, [](const LockstepFlight& flight) { return flight.flown.outcome == Outcome::kCollision; });
  }
};

TEST_P(SceneFlights, EndAtTheGoal) { expectAllAtTheGoal(fly(kFew, kSmall, {})); }

/// Else the flights above would prove nothing.
TEST_P(SceneFlights, OfABlindPlannerEndInACrash) { EXPECT_EQ(collisions(fly(kFew, kSmall, blindToObstacles())), kFew); }

TEST_P(SceneFlights, TenSeedsEndAtTheGoal) { expectAllAtTheGoal(fly(kTen, kPapers, {})); }

TEST_P(SceneFlights, TenSeedsOfABlindPlannerEndInACrashButForOne) {
  EXPECT_GE(collisions(fly(kTen, kPapers, blindToObstacles())), kTen - 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneFlights, testing::Values("forest", "wall", "warehouse"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace nanomap::sim
