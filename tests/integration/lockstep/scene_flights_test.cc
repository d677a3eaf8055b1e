#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "firmware_app/configuration/load.h"
#include "tests/integration/lockstep/at_the_goal.h"
#include "tools/generate/paper_camera.h"
#include "tools/sim/blindness.h"

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
    for (const LockstepFlight& flight : flights) expectAtTheGoal(flight);
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
