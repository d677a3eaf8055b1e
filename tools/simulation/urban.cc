#include "tools/simulation/urban.h"

#include <cmath>
#include <utility>
#include <vector>

#include "tools/simulation/random.h"

namespace nanomap::simulation {
namespace {

constexpr int kBlocksAlongX = 4;
constexpr int kBlocksAlongY = 3;
constexpr double kBlock_m = 24.0;
constexpr double kStreet_m = 11.0;
constexpr double kPitch_m = kBlock_m + kStreet_m;
constexpr double kAltitude_m = 3.0;

/// Four buildings with small setbacks on the block whose corner nearest to the origin is `corner_W`.
void addBlock(const Vec3& corner_W, Random& random, std::vector<Solid>& solids) {
  constexpr double kHalf_m = kBlock_m / 4.0;
  for (const double x : {1.0, 3.0}) {
    for (const double y : {1.0, 3.0}) {
      const double height_m = uniform(random, 8.0, 30.0);
      const double setback_x_m = uniform(random, 0.0, 1.5);
      const double setback_y_m = uniform(random, 0.0, 1.5);
      solids.emplace_back(UprightBox{.center_W = corner_W + Vec3(x * kHalf_m, y * kHalf_m, height_m / 2.0),
                                     .half_size_m = {kHalf_m - setback_x_m, kHalf_m - setback_y_m, height_m / 2.0}});
    }
  }
}

/// What stands along one street of `length_m` whose middle runs from `from_W` in `direction`.
void addStreetFurniture(const Vec3& from_W, const Vec3& direction, double length_m, Random& random,
                        std::vector<Solid>& solids) {
  constexpr double kCarShare = 0.5;
  constexpr double kTreeShare = 0.4;
  constexpr double kSpacing_m = 9.0;
  const Vec3 left = Vec3::UnitZ().cross(direction);
  for (double along_m = kSpacing_m / 2.0; along_m < length_m; along_m += kSpacing_m) {
    for (const double side : {1.0, -1.0}) {
      const Vec3 kerb_W = from_W + (along_m + uniform(random, -2.0, 2.0)) * direction;
      const Vec3 post_W = kerb_W + side * (kStreet_m / 2.0 - 0.8) * left;
      const double height_m = uniform(random, 4.5, 7.0);
      if (chance(random, kTreeShare)) {
        solids.emplace_back(Cylinder{post_W, post_W + height_m * Vec3::UnitZ(), 0.15});
        solids.emplace_back(Sphere{post_W + height_m * Vec3::UnitZ(), uniform(random, 0.8, 1.6)});
      } else {
        const Vec3 lamp_W = post_W + height_m * Vec3::UnitZ();
        solids.emplace_back(Cylinder{post_W, lamp_W, 0.07});
        solids.emplace_back(Cylinder{lamp_W, lamp_W - side * 1.5 * left, 0.04});
      }
      if (chance(random, kCarShare)) {
        const Vec3 car_W = kerb_W + 2.0 * direction + side * (kStreet_m / 2.0 - 2.2) * left;
        const bool van = chance(random, 0.2);
        const double half_height_m = van ? 1.3 : 0.75;
        solids.emplace_back(UprightBox{.center_W = car_W + half_height_m * Vec3::UnitZ(),
                                       .half_size_m = {2.2, 0.95, half_height_m},
                                       .yaw_rad = std::atan2(direction.y(), direction.x())});
      }
    }
  }
}

}  // namespace

Scene makeUrban(std::uint64_t seed) {
  // Street i runs along the low side of block i; its middle is at i * kPitch_m. The flight starts at the first
  // crossing.
  constexpr double kLengthX_m = kBlocksAlongX * kPitch_m;
  constexpr double kLengthY_m = kBlocksAlongY * kPitch_m;
  constexpr double kMargin_m = kStreet_m / 2.0;
  Random random(seed);
  std::vector<Solid> solids;
  for (int i = 0; i < kBlocksAlongX; ++i) {
    for (int j = 0; j < kBlocksAlongY; ++j) {
      addBlock({i * kPitch_m + kStreet_m / 2.0, j * kPitch_m + kStreet_m / 2.0, 0.0}, random, solids);
    }
  }
  for (int i = 0; i <= kBlocksAlongX; ++i) {
    addStreetFurniture({i * kPitch_m, kMargin_m, 0.0}, Vec3::UnitY(), kLengthY_m - kMargin_m, random, solids);
  }
  for (int j = 0; j <= kBlocksAlongY; ++j) {
    addStreetFurniture({kMargin_m, j * kPitch_m, 0.0}, Vec3::UnitX(), kLengthX_m - kMargin_m, random, solids);
  }

  Mission mission;
  mission.start_W = {0.0, 0.0, kAltitude_m};
  mission.goal_W = {(kBlocksAlongX - 1) * kPitch_m, (kBlocksAlongY - 1) * kPitch_m, kAltitude_m};
  mission.region_W =
      Box3(Vec3(-kMargin_m, -kMargin_m, 0.0), Vec3(kLengthX_m + kMargin_m, kLengthY_m + kMargin_m, 4.0 * kAltitude_m));
  return {"urban", std::move(mission), std::move(solids)};
}

}  // namespace nanomap::simulation
