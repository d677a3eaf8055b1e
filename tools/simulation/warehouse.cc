#include "tools/simulation/warehouse.h"

#include <array>
#include <utility>
#include <vector>

#include "tools/simulation/random.h"

namespace nanomap::simulation {
namespace {

constexpr double kAisleLength_m = 70.0;
constexpr double kAisleHalfWidth_m = 2.0;
constexpr double kRackDepth_m = 1.1;
constexpr double kRackHeight_m = 6.0;
constexpr double kBay_m = 2.8;  // between uprights
constexpr double kHallHeight_m = 8.0;
constexpr double kAltitude_m = 1.6;
constexpr std::array<double, 4> kShelves_m = {0.15, 1.9, 3.6, 5.3};

UprightBox boxBetween(const Vec3& corner_W, const Vec3& opposite_W) {
  return {.center_W = (corner_W + opposite_W) / 2.0, .half_size_m = (opposite_W - corner_W).cwiseAbs() / 2.0};
}

/// One row of racks. `side` is 1 on the left of the aisle, -1 on its right.
void addRack(double side, Random& random, std::vector<Solid>& solids) {
  constexpr double kUpright_m = 0.1;
  constexpr double kBeam_m = 0.12;
  constexpr double kPalletShare = 0.7;
  const double front_m = side * kAisleHalfWidth_m;
  const double back_m = side * (kAisleHalfWidth_m + kRackDepth_m);
  for (double x_m = 0.0; x_m < kAisleLength_m; x_m += kBay_m) {
    for (const double y_m : {front_m, back_m - side * kUpright_m}) {
      solids.emplace_back(boxBetween({x_m, y_m, 0.0}, {x_m + kUpright_m, y_m + side * kUpright_m, kRackHeight_m}));
    }
    for (const double shelf_m : kShelves_m) {
      for (const double y_m : {front_m, back_m - side * kUpright_m}) {
        solids.emplace_back(
            boxBetween({x_m, y_m, shelf_m - kBeam_m}, {x_m + kBay_m, y_m + side * kUpright_m / 2.0, shelf_m}));
      }
      for (const double place_m : {0.2, 1.5}) {
        if (!chance(random, kPalletShare)) continue;
        const double height_m = uniform(random, 0.4, 1.3);
        const double depth_m = uniform(random, 0.7, kRackDepth_m - 0.2);
        solids.emplace_back(boxBetween({x_m + place_m, back_m, shelf_m},
                                       {x_m + place_m + 1.1, back_m - side * depth_m, shelf_m + height_m}));
      }
    }
  }
}

}  // namespace

Scene makeWarehouse(std::uint64_t seed) {
  constexpr double kWallThickness_m = 0.3;
  constexpr double kHallHalfWidth_m = kAisleHalfWidth_m + kRackDepth_m + 3.0;
  constexpr double kHallMargin_m = 6.0;  // beyond both ends of the aisle
  Random random(seed);
  std::vector<Solid> solids;
  for (const double side : {1.0, -1.0}) {
    addRack(side, random, solids);
    const double wall_m = side * kHallHalfWidth_m;
    solids.emplace_back(boxBetween({-kHallMargin_m, wall_m, 0.0},
                                   {kAisleLength_m + kHallMargin_m, wall_m + side * kWallThickness_m, kHallHeight_m}));
  }
  for (const double end_m : {-kHallMargin_m, kAisleLength_m + kHallMargin_m}) {
    solids.emplace_back(boxBetween({end_m - kWallThickness_m / 2.0, -kHallHalfWidth_m, 0.0},
                                   {end_m + kWallThickness_m / 2.0, kHallHalfWidth_m, kHallHeight_m}));
  }
  solids.emplace_back(boxBetween({-kHallMargin_m, -kHallHalfWidth_m, kHallHeight_m},
                                 {kAisleLength_m + kHallMargin_m, kHallHalfWidth_m, kHallHeight_m + kWallThickness_m}));

  double side = chance(random, 0.5) ? 1.0 : -1.0;
  for (double x_m = 9.0; x_m < kAisleLength_m - 6.0; x_m += uniform(random, 6.0, 11.0)) {
    // Some leave no straight way through, all leave one of 2 m beside them.
    const double into_aisle_m = uniform(random, 1.0, 2.0);
    const double height_m = uniform(random, 1.9, 2.6);
    solids.emplace_back(boxBetween({x_m, side * kAisleHalfWidth_m, 0.0},
                                   {x_m + 1.2, side * (kAisleHalfWidth_m - into_aisle_m), height_m}));
    side = -side;
  }
  for (double x_m = 12.0; x_m < kAisleLength_m - 6.0; x_m += uniform(random, 8.0, 14.0)) {
    const double z_m = uniform(random, 3.0, 5.0);
    solids.emplace_back(Cylinder{{x_m, -kAisleHalfWidth_m, z_m}, {x_m, kAisleHalfWidth_m, z_m}, 0.04});
  }

  Mission mission;
  mission.start_W = {-3.0, 0.0, kAltitude_m};
  mission.goal_W = {kAisleLength_m + 3.0, 0.0, kAltitude_m};
  mission.region_W = Box3(Vec3(-kHallMargin_m, -kAisleHalfWidth_m, 0.0),
                          Vec3(kAisleLength_m + kHallMargin_m, kAisleHalfWidth_m, kRackHeight_m));
  return {"warehouse", std::move(mission), std::move(solids)};
}

}  // namespace nanomap::simulation
