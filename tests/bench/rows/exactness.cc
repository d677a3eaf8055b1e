#include "tests/bench/rows/exactness.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "tests/bench/references/linear_scan.h"
#include "tests/bench/references/point_cloud.h"

namespace nanomap::bench {
namespace {

struct Question {
  std::size_t k;
  float max_distance_m;
};
constexpr std::array kQuestions = {Question{1, NearestPointIndex::kAnyDistance},
                                   Question{10, NearestPointIndex::kAnyDistance},
                                   Question{16, NearestPointIndex::kAnyDistance}, Question{10, 1.0F}};

/// `truth_m`: as many distances as any question asks for.
std::size_t countDifferences(const NearestPointIndex& index, const Vec3f& p_C, const std::vector<float>& truth_m) {
  std::size_t differ = 0;
  for (const auto& [k, max_distance_m] : kQuestions) {
    std::array<Neighbour, kMaxNeighbours> found;
    const std::size_t count = index.nearest(p_C, std::span(found).first(k), max_distance_m);
    std::size_t expected = 0;
    while (expected < std::min(k, truth_m.size()) && truth_m[expected] <= max_distance_m) ++expected;
    for (std::size_t i = 0; i < std::max(count, expected); ++i) {
      if (i >= count || i >= expected || found[i].distance_m != truth_m[i]) ++differ;
    }
  }
  return differ;
}

std::vector<Vec3f> pointsAround(std::size_t count) {
  constexpr unsigned kSeed = 12;
  constexpr float kReach_m = 25.0F;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> coordinate_m(-kReach_m, kReach_m);
  std::vector<Vec3f> points_C(count);
  for (Vec3f& p_C : points_C) {
    for (int axis = 0; axis < 3; ++axis) p_C[axis] = coordinate_m(random);
  }
  return points_C;
}

}  // namespace

void rateExactness(const IndexFixture& fixture, std::size_t count, Scoreboard& scoreboard, const std::string& where) {
  const std::vector<Vec3f> cloud_C = pointCloud(fixture.image, *fixture.camera);
  std::size_t ours = 0;
  std::vector<std::size_t> theirs(fixture.references.size(), 0);
  const auto check = [&](const Vec3f& p_C) {
    const std::vector<float> truth_m = nearestDistances(cloud_C, p_C, kMaxNeighbours);
    ours += countDifferences(fixture.view.index(), p_C, truth_m);
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      theirs[i] += countDifferences(*fixture.references[i].index, p_C, truth_m);
    }
  };
  for (const IndexFixture::PointSet& set : fixture.sets) {
    // Evenly from the whole set: its beginning may be one primitive.
    const std::size_t stride = std::max<std::size_t>(set.points_C.size() / count, 1);
    for (std::size_t i = 0; i < set.points_C.size(); i += stride) check(set.points_C[i]);
  }
  for (const Vec3f& p_C : pointsAround(count)) check(p_C);
  scoreboard.rate("distances_that_differ", static_cast<double>(ours), where);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (theirs[i] == 0) continue;
    scoreboard.remark(where + ": " + std::to_string(theirs[i]) + " distances of " + fixture.references[i].name +
                      " differ from a linear scan");
  }
}

}  // namespace nanomap::bench
