#include "tools/simulation/forest.h"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>
#include <variant>
#include <vector>

namespace nanomap::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Trunks are the upright cylinders.
std::vector<Cylinder> trunksOf(const Scene& forest) {
  std::vector<Cylinder> trunks;
  for (const Solid& solid : forest.obstacles()) {
    const Cylinder* cylinder = std::get_if<Cylinder>(&solid);
    if (cylinder != nullptr && (cylinder->top_W - cylinder->base_W).head<2>().norm() == 0.0)
      trunks.push_back(*cylinder);
  }
  return trunks;
}

/// Whether a vehicle that flies straight on from the start meets a trunk, tried step by step.
bool meetsATrunk(const std::vector<Cylinder>& trunks, const Vec3& start_W, double heading_rad, double radius_m,
                 double length_m) {
  constexpr double kStep_m = 0.05;
  for (double range_m = 0.0; range_m < length_m; range_m += kStep_m) {
    const Vec3 p_W = start_W + range_m * Vec3(std::cos(heading_rad), std::sin(heading_rad), 0.0);
    for (const Cylinder& trunk : trunks) {
      if ((trunk.base_W - p_W).head<2>().norm() < trunk.radius_m + radius_m) return true;
    }
  }
  return false;
}

TEST(Forest, HasAtLeastFiveTreesPerHundredSquareMetres) {
  const ForestParameters parameters;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double trees = static_cast<double>(trunksOf(makeForest(seed)).size());
    EXPECT_GE(trees / (parameters.length_m * 2.0 * parameters.half_width_m), 0.05) << "seed " << seed;
  }
}

TEST(Forest, HasNoStraightFreeCorridor) {
  constexpr double kVehicleRadius_m = 0.4;
  constexpr double kLength_m = 100.0;
  constexpr double kFanStep_rad = 0.002;  // 0.2 m at the far end
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scene forest = makeForest(seed);
    const std::vector<Cylinder> trunks = trunksOf(forest);
    const double last_rad = std::asin(forest.mission().region_W.max().y() / kLength_m);
    for (double heading_rad = -last_rad; heading_rad <= last_rad; heading_rad += kFanStep_rad) {
      EXPECT_TRUE(meetsATrunk(trunks, forest.mission().start_W, heading_rad, kVehicleRadius_m, kLength_m))
          << "heading " << heading_rad << ", seed " << seed;
    }
  }
}

TEST(Forest, ClosesCorridorsThatSparseTreesLeave) {
  ForestParameters sparse;
  sparse.trees_per_m2 = 0.005;
  const Scene forest = makeForest(1, sparse);
  const std::vector<Cylinder> trunks = trunksOf(forest);
  EXPECT_GT(static_cast<double>(trunks.size()), sparse.trees_per_m2 * sparse.length_m * 2.0 * sparse.half_width_m);
  for (double heading_rad = -0.28; heading_rad <= 0.28; heading_rad += 0.002) {
    EXPECT_TRUE(meetsATrunk(trunks, forest.mission().start_W, heading_rad, 0.4, 100.0)) << heading_rad;
  }
}

TEST(Forest, HasThinBranchesAtFlightAltitude) {
  int thin = 0;
  const Scene forest = makeForest(1);
  for (const Solid& solid : forest.obstacles()) {
    const Cylinder* cylinder = std::get_if<Cylinder>(&solid);
    thin += cylinder != nullptr && cylinder->radius_m < 0.03 && cylinder->base_W.z() < 3.0;
  }
  EXPECT_GT(thin, 50);
}

TEST(Forest, TooDenseForTheSpacingIsRefused) {
  ForestParameters dense;
  dense.trees_per_m2 = 1.0;
  EXPECT_THAT([&] { (void)makeForest(1, dense); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("trees_per_m2"), HasSubstr("min_spacing_m"))));
}

}  // namespace
}  // namespace nanomap::simulation
