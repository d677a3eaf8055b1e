#include "tools/simulation/forest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/simulation/random.h"

namespace nanomap::simulation {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kThinnestTrunk_m = 0.12;
constexpr double kThickestTrunk_m = 0.32;
constexpr double kClearing_m = 4.0;  // around start and goal

struct Trunk {
  Vec2 position_m = Vec2::Zero();  // from the start
  double radius_m = 0.0;
};

double distanceToNearestTrunk(const std::vector<Trunk>& trunks, const Vec2& position_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Trunk& trunk : trunks) nearest_m = std::min(nearest_m, (trunk.position_m - position_m).norm());
  return nearest_m;
}

std::vector<Trunk> scatterTrunks(const ForestParameters& forest, Random& random) {
  constexpr std::size_t kTriesPerTree = 200;
  const double area_m2 = forest.length_m * 2.0 * forest.half_width_m;
  const auto wanted = static_cast<std::size_t>(std::ceil(forest.trees_per_m2 * area_m2));
  const Vec2 goal_m(forest.length_m, 0.0);
  std::vector<Trunk> trunks;
  for (std::size_t tries = 0; trunks.size() < wanted; ++tries) {
    if (tries == kTriesPerTree * wanted) {
      throw std::invalid_argument("forest: " + std::to_string(wanted) + " trees (trees_per_m2) do not fit with " +
                                  std::to_string(forest.min_spacing_m) + " m between them (min_spacing_m)");
    }
    const double x_m = uniform(random, 0.0, forest.length_m);
    const double y_m = uniform(random, -forest.half_width_m, forest.half_width_m);
    const Vec2 position_m(x_m, y_m);
    if (position_m.norm() < kClearing_m || (position_m - goal_m).norm() < kClearing_m ||
        distanceToNearestTrunk(trunks, position_m) < forest.min_spacing_m) {
      continue;
    }
    trunks.push_back({position_m, uniform(random, kThinnestTrunk_m, kThickestTrunk_m)});
  }
  return trunks;
}

struct HeadingInterval {
  double from_rad = 0.0;
  double to_rad = 0.0;
};

/// The headings that the trunk blocks for a tube from the start.
HeadingInterval blockedHeadings(const Trunk& trunk, double corridor_radius_m) {
  const double bearing_rad = std::atan2(trunk.position_m.y(), trunk.position_m.x());
  const double half_rad = std::asin(std::min((trunk.radius_m + corridor_radius_m) / trunk.position_m.norm(), 1.0));
  return {bearing_rad - half_rad, bearing_rad + half_rad};
}

/// The headings, out of those that stay inside the forest, along which a tube from the start meets no trunk.
std::vector<HeadingInterval> freeHeadings(const std::vector<Trunk>& trunks, const ForestParameters& forest) {
  std::vector<HeadingInterval> blocked;
  for (const Trunk& trunk : trunks) {
    if (trunk.position_m.norm() <= forest.corridor_length_m) {
      blocked.push_back(blockedHeadings(trunk, forest.corridor_radius_m));
    }
  }
  std::sort(blocked.begin(), blocked.end(), [](const auto& a, const auto& b) { return a.from_rad < b.from_rad; });
  const double last_rad = std::asin(forest.half_width_m / forest.corridor_length_m);
  double covered_to_rad = -last_rad;
  std::vector<HeadingInterval> free;
  for (const HeadingInterval& interval : blocked) {
    if (interval.from_rad > covered_to_rad && covered_to_rad < last_rad) {
      free.push_back({covered_to_rad, std::min(interval.from_rad, last_rad)});
    }
    covered_to_rad = std::max(covered_to_rad, interval.to_rad);
  }
  if (covered_to_rad < last_rad) free.push_back({covered_to_rad, last_rad});
  return free;
}

/// A trunk in the middle of the free headings, where it is loneliest.
Trunk closingTrunk(const std::vector<Trunk>& trunks, const HeadingInterval& free, const ForestParameters& forest,
                   Random& random) {
  constexpr int kCandidates = 200;
  const double heading_rad = (free.from_rad + free.to_rad) / 2.0;
  Trunk loneliest;
  double loneliest_m = -1.0;
  for (int i = 0; i < kCandidates; ++i) {
    const double range_m = uniform(random, 2.0 * kClearing_m, forest.corridor_length_m);
    const Vec2 position_m = range_m * Vec2(std::cos(heading_rad), std::sin(heading_rad));
    const double distance_m = distanceToNearestTrunk(trunks, position_m);
    if (distance_m > loneliest_m) {
      loneliest_m = distance_m;
      loneliest.position_m = position_m;
    }
  }
  loneliest.radius_m = uniform(random, kThinnestTrunk_m, kThickestTrunk_m);
  return loneliest;
}

void growTree(const Trunk& trunk, Random& random, std::vector<Solid>& solids) {
  constexpr double kBranchShare = 0.6;  // of trees with branches in reach of a flight
  constexpr double kCrownShare = 0.4;
  const double height_m = uniform(random, 7.0, 12.0);
  const Vec3 foot_W(trunk.position_m.x(), trunk.position_m.y(), 0.0);
  solids.emplace_back(Cylinder{foot_W, foot_W + height_m * Vec3::UnitZ(), trunk.radius_m});
  if (chance(random, kBranchShare)) {
    const int branches = std::uniform_int_distribution<int>(1, 4)(random);
    for (int i = 0; i < branches; ++i) {
      const double branch_height_m = uniform(random, 1.0, 5.0);
      const double heading_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
      const double rise_rad = uniform(random, 0.1, 0.8);
      const double length_m = trunk.radius_m + uniform(random, 0.4, 1.1);
      const double radius_m = uniform(random, 0.01, 0.03);
      const Vec3 base_W = foot_W + branch_height_m * Vec3::UnitZ();
      const Vec3 direction(std::cos(rise_rad) * std::cos(heading_rad), std::cos(rise_rad) * std::sin(heading_rad),
                           std::sin(rise_rad));
      solids.emplace_back(Cylinder{base_W, base_W + length_m * direction, radius_m});
    }
  }
  if (chance(random, kCrownShare)) {
    solids.emplace_back(Sphere{foot_W + height_m * Vec3::UnitZ(), uniform(random, 1.0, 2.0)});
  }
}

}  // namespace

Scene makeForest(std::uint64_t seed, const ForestParameters& parameters) {
  Random random(seed);
  std::vector<Trunk> trunks = scatterTrunks(parameters, random);
  for (auto free = freeHeadings(trunks, parameters); !free.empty(); free = freeHeadings(trunks, parameters)) {
    trunks.push_back(closingTrunk(trunks, free.front(), parameters, random));
  }
  std::vector<Solid> solids;
  for (const Trunk& trunk : trunks) growTree(trunk, random, solids);
  Mission mission;
  mission.start_W = {0.0, 0.0, parameters.altitude_m};
  mission.goal_W = {parameters.length_m, 0.0, parameters.altitude_m};
  mission.region_W =
      Box3(Vec3(-kClearing_m, -parameters.half_width_m, 0.0),
           Vec3(parameters.length_m + kClearing_m, parameters.half_width_m, 2.0 * parameters.altitude_m));
  return {"forest", std::move(mission), std::move(solids)};
}

}  // namespace nanomap::simulation
