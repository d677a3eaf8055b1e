#include "tools/simulation/flight_path.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tools/simulation/scene_catalogue.h"

namespace nanomap::simulation {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Duration kStep = std::chrono::milliseconds(4);
constexpr std::uint64_t kSeeds = 6;

double tilt(const VehicleState& state) { return std::acos((state.T_W_B.rotation * Vec3::UnitZ()).z()); }

double yaw(const VehicleState& state) {
  const Vec3 x_W = state.T_W_B.rotation * Vec3::UnitX();
  return std::atan2(x_W.y(), x_W.x());
}

template <typename Check>
void forEveryState(const FlightPath& path, Check check) {
  for (Duration elapsed{}; elapsed <= path.duration(); elapsed += kStep) check(elapsed, path.at(elapsed));
}

class EveryFlight : public testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryFlight, testing::ValuesIn(kSceneNames),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_P(EveryFlight, KeepsItsClearanceFromStartToGoal) {
  const FlightParameters parameters;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Scene scene = makeScene(GetParam(), seed);
    const FlightPath path(scene, parameters, seed);
    forEveryState(path, [&](Duration elapsed, const VehicleState& state) {
      const Vec3& p_W = state.T_W_B.translation_m;
      ASSERT_GE(scene.distanceToNearestObstacle(p_W), parameters.min_clearance_m - 0.01)
          << toSeconds(elapsed) << " s, seed " << seed;
      ASSERT_GE(p_W.z(), parameters.min_clearance_m);
    });
    EXPECT_LT((path.at(Duration{}).T_W_B.translation_m - scene.mission().start_W).norm(), 0.1);
    EXPECT_LT((path.at(path.duration()).T_W_B.translation_m - scene.mission().goal_W).norm(), 0.1);
    EXPECT_LT(path.at(Duration{}).velocity_W_m_s.norm(), 1e-6);
    EXPECT_LT(path.at(path.duration()).velocity_W_m_s.norm(), 1e-6);
  }
}

TEST_P(EveryFlight, StaysWithinTheVehiclesLimits) {
  const FlightParameters parameters;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FlightPath path(makeScene(GetParam(), seed), parameters, seed);
    double fastest_m_s = 0.0;
    double steepest_rad = 0.0;
    double last_yaw_rad = yaw(path.at(Duration{}));
    forEveryState(path, [&](Duration elapsed, const VehicleState& state) {
      const double turned_rad = std::remainder(yaw(state) - last_yaw_rad, 2.0 * std::numbers::pi);
      ASSERT_LE(std::abs(turned_rad) / toSeconds(kStep), 1.05 * parameters.max_yaw_rate_rad_s)
          << toSeconds(elapsed) << " s, seed " << seed;
      last_yaw_rad = yaw(state);
      ASSERT_LE(tilt(state), parameters.max_tilt_rad);
      ASSERT_LE(state.velocity_W_m_s.norm(), 1.05 * parameters.cruise_speed_m_s);
      fastest_m_s = std::max(fastest_m_s, state.velocity_W_m_s.norm());
      steepest_rad = std::max(steepest_rad, tilt(state));
    });
    EXPECT_GT(fastest_m_s, 0.7 * parameters.cruise_speed_m_s) << "seed " << seed;
    EXPECT_GT(steepest_rad, 0.5) << "never braked hard, seed " << seed;
  }
}

TEST_P(EveryFlight, DerivativesBelongToThePositions) {
  const FlightPath path(makeScene(GetParam(), 1), {}, 1);
  VehicleState before = path.at(Duration{});
  forEveryState(path, [&](Duration elapsed, const VehicleState& state) {
    if (elapsed == Duration{}) return;
    const double step_s = toSeconds(kStep);
    const Vec3 moved_m = state.T_W_B.translation_m - before.T_W_B.translation_m;
    ASSERT_LT((moved_m / step_s - (state.velocity_W_m_s + before.velocity_W_m_s) / 2.0).norm(), 0.01);
    const Vec3 gained_m_s = state.velocity_W_m_s - before.velocity_W_m_s;
    ASSERT_LT((gained_m_s / step_s - (state.acceleration_W_m_s2 + before.acceleration_W_m_s2) / 2.0).norm(), 0.3);
    before = state;
  });
}

TEST_P(EveryFlight, ThrustPointsWhereTheAccelerationNeedsIt) {
  const Vec3 kGravity_W_m_s2(0.0, 0.0, 9.80665);
  const FlightPath path(makeScene(GetParam(), 1), {}, 1);
  forEveryState(path, [&](Duration, const VehicleState& state) {
    const Vec3 thrust_W = (state.acceleration_W_m_s2 + kGravity_W_m_s2).normalized();
    ASSERT_LT((state.T_W_B.rotation * Vec3::UnitZ() - thrust_W).norm(), 1e-3);
  });
}

TEST_P(EveryFlight, LooksWhereItFlies) {
  const FlightPath path(makeScene(GetParam(), 2), {}, 2);
  forEveryState(path, [&](Duration elapsed, const VehicleState& state) {
    const Vec3& v = state.velocity_W_m_s;
    if (v.head<2>().norm() < 3.0) return;
    EXPECT_LT(std::abs(std::remainder(yaw(state) - std::atan2(v.y(), v.x()), 2.0 * std::numbers::pi)), 0.35)
        << toSeconds(elapsed) << " s";
  });
}

TEST_P(EveryFlight, HoversBeforeAndAfter) {
  const FlightPath path(makeScene(GetParam(), 1), {}, 1);
  const Duration hour = std::chrono::hours(1);
  EXPECT_EQ(path.at(-hour).T_W_B.translation_m, path.at(Duration{}).T_W_B.translation_m);
  EXPECT_EQ(path.at(path.duration() + hour).T_W_B.translation_m, path.at(path.duration()).T_W_B.translation_m);
  EXPECT_LT(tilt(path.at(path.duration() + hour)), 1e-6);
}

TEST(FlightPath, SeedDrawsTheSpeeds) {
  const Scene scene = makeScene("wall", 1);
  const Duration midway = std::chrono::seconds(15);
  const auto positionMidway = [&](std::uint64_t seed) {
    return FlightPath(scene, {}, seed).at(midway).T_W_B.translation_m;
  };
  EXPECT_EQ(positionMidway(1), positionMidway(1));
  EXPECT_GT((positionMidway(1) - positionMidway(2)).norm(), 0.1);
}

TEST(FlightPath, WithoutAWayThroughTheSceneIsNamed) {
  Mission mission;
  mission.start_W = {0.0, 0.0, 2.0};
  mission.goal_W = {20.0, 0.0, 2.0};
  mission.region_W = Box3(Vec3(-2.0, -5.0, 0.0), Vec3(22.0, 5.0, 4.0));
  const Scene closed("closed", mission, {UprightBox{.center_W = {10.0, 0.0, 2.0}, .half_size_m = {0.5, 6.0, 2.0}}});
  EXPECT_THAT([&] { FlightPath(closed, {}, 1); }, ThrowsMessage<std::runtime_error>(HasSubstr("'closed'")));
}

TEST(FlightPath, GoalAtTheStartIsRefused) {
  Mission mission;
  mission.start_W = mission.goal_W = {0.0, 0.0, 2.0};
  mission.region_W = Box3(Vec3::Constant(-2.0), Vec3::Constant(3.0));
  EXPECT_THAT([&] { FlightPath(Scene("still", mission, {}), {}, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("'still'")));
}

TEST(FlightPath, WrongParametersAreNamed) {
  FlightParameters parameters;
  parameters.cruise_speed_m_s = std::numeric_limits<double>::quiet_NaN();
  const Scene scene = makeScene("wall", 1);
  EXPECT_THAT([&] { FlightPath(scene, parameters, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("cruise_speed_m_s")));
}

}  // namespace
}  // namespace nanomap::simulation
