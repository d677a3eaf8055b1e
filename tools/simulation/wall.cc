#include "tools/simulation/wall.h"

#include <utility>
#include <vector>

#include "tools/simulation/random.h"

namespace nanomap::simulation {

Scene makeWall(std::uint64_t seed) {
  constexpr double kAltitude_m = 5.0;
  constexpr double kWall_m = 100.0;  // ahead of the start
  constexpr double kGoal_m = 200.0;
  constexpr double kTurnAway_m = 18.0;  // from the wall, which a camera then sees in full
  constexpr double kRegionHalfWidth_m = 45.0;
  Random random(seed);
  std::vector<Solid> solids;

  const double left_m = uniform(random, 16.0, 26.0);
  const double right_m = uniform(random, 16.0, 26.0);
  const double depth_m = uniform(random, 10.0, 16.0);
  const double height_m = uniform(random, 16.0, 24.0);
  const double middle_y_m = (left_m - right_m) / 2.0;
  const double half_width_m = (left_m + right_m) / 2.0;
  solids.emplace_back(UprightBox{.center_W = {kWall_m + depth_m / 2.0, middle_y_m, height_m / 2.0},
                                 .half_size_m = {depth_m / 2.0, half_width_m, height_m / 2.0}});

  const double overhang_m = uniform(random, 4.0, 7.0);
  const double underside_m = uniform(random, kAltitude_m + 0.3, kAltitude_m + 1.2);
  const double overhang_height_m = uniform(random, 3.0, 5.0);
  solids.emplace_back(
      UprightBox{.center_W = {kWall_m - overhang_m / 2.0, middle_y_m, underside_m + overhang_height_m / 2.0},
                 .half_size_m = {overhang_m / 2.0, 0.8 * half_width_m, overhang_height_m / 2.0}});
  for (const double side : {-0.7, 0.0, 0.7}) {
    const Vec3 foot_W(kWall_m - 0.9 * overhang_m, middle_y_m + side * half_width_m, 0.0);
    solids.emplace_back(Cylinder{foot_W, foot_W + underside_m * Vec3::UnitZ(), 0.2});
  }

  constexpr int kLampPosts = 12;
  for (int i = 0; i < kLampPosts; ++i) {
    const double x_m = uniform(random, 12.0, kWall_m - 22.0);
    const double y_m = uniform(random, -20.0, 20.0);
    const Vec3 foot_W(x_m, y_m, 0.0);
    solids.emplace_back(Cylinder{foot_W, foot_W + uniform(random, 6.0, 8.0) * Vec3::UnitZ(), 0.08});
  }
  constexpr int kParkedCars = 10;
  for (int i = 0; i < kParkedCars; ++i) {
    const double x_m = uniform(random, 15.0, kWall_m - 25.0);
    const double y_m = uniform(random, -25.0, 25.0);
    solids.emplace_back(UprightBox{
        .center_W = {x_m, y_m, 0.75}, .half_size_m = {2.2, 0.9, 0.75}, .yaw_rad = uniform(random, -0.5, 0.5)});
  }

  Mission mission;
  mission.start_W = {0.0, 0.0, kAltitude_m};
  mission.goal_W = {kGoal_m, 0.0, kAltitude_m};
  mission.via_W = {{kWall_m - kTurnAway_m, 0.0, kAltitude_m}};
  mission.region_W =
      Box3(Vec3(-5.0, -kRegionHalfWidth_m, 0.0), Vec3(kGoal_m + 5.0, kRegionHalfWidth_m, 2.0 * kAltitude_m));
  return {"wall", std::move(mission), std::move(solids)};
}

}  // namespace nanomap::simulation
