#include "tests/bench/rows/index_contests.h"

#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <utility>

#include "core/flann_index.h"

namespace nanomap::bench {
namespace {

using Fixture = std::shared_ptr<const IndexFixture>;

void askAll(const NearestPointIndex& index, const std::vector<Vec3f>& points_C, std::size_t k, float max_distance_m) {
  std::array<Neighbour, kMaxNeighbours> out;
  for (const Vec3f& p_C : points_C) {
    benchmark::DoNotOptimize(index.nearest(p_C, std::span(out).first(k), max_distance_m));
  }
  benchmark::ClobberMemory();
}

/// @param fixture  what `index` and `set` are part of
Contestant asker(Fixture fixture, std::string name, const NearestPointIndex& index, const IndexFixture::PointSet& set,
                 std::size_t k, float max_distance_m) {
  return {.name = std::move(name),
          .items = static_cast<double>(set.points_C.size()),
          .run = [fixture = std::move(fixture), &index, &set, k, max_distance_m] {
            askAll(index, set.points_C, k, max_distance_m);
          }};
}

Contestant builder(Fixture fixture, std::string name, double items) {
  const auto view = std::make_shared<View>(fixture->camera, IndexKind::kImage);
  return {.name = std::move(name), .items = items, .run = [fixture, view] { view->assign(fixture->image); }};
}

}  // namespace

Contest buildContest(Fixture fixture) {
  Contest contest{.name = "build", .contestants = {builder(fixture, "nanomap", 1.0)}, .ratings = {}};
  contest.contestants.push_back({.name = "flann15", .run = [fixture] {
                                   benchmark::DoNotOptimize(buildFlannIndex(fixture->image, *fixture->camera));
                                 }});
  for (const int leaf : {kNanoflannLeaves.front(), kNanoflannLeaves.back()}) {
    contest.contestants.push_back({.name = "nanoflann" + std::to_string(leaf), .run = [fixture, leaf] {
                                     benchmark::DoNotOptimize(
                                         buildNanoflannIndex(fixture->image, *fixture->camera, leaf));
                                   }});
  }
  contest.ratings = {{"build/flann15", "flann15"}, {"build/nanoflann10", "nanoflann10"}};
  return contest;
}

std::vector<Contest> nearestContests(Fixture fixture, Noise noise) {
  const std::string noise_name = noise == Noise::kNoisy ? "noisy" : "clean";
  struct Question {
    std::string name;
    std::size_t k;
    float max_distance_m;
    std::vector<Rating> ratings;
  };
  const std::array<Question, 3> questions{{
      {"nearest_k1",
       1,
       NearestPointIndex::kAnyDistance,
       {{"nearest_k1_" + noise_name + "/nanoflann", "nanoflann"}, {"nearest_k1/flann15", "flann15"}}},
      {"nearest_k10",
       10,
       NearestPointIndex::kAnyDistance,
       {{"nearest_k10_" + noise_name + "/nanoflann", "nanoflann"}, {"nearest_k10/flann15", "flann15"}}},
      {"nearest_k1_within_1m", 1, 1.0F, {{"nearest_k1_within_1m/nanoflann", "nanoflann"}}},
  }};
  std::vector<Contest> contests;
  for (const Question& question : questions) {
    for (const IndexFixture::PointSet& set : fixture->sets) {
      Contest contest{.name = question.name + "_" + set.name, .contestants = {}, .ratings = question.ratings};
      const auto enter = [&](const std::string& name, const NearestPointIndex& index) {
        contest.contestants.push_back(asker(fixture, name, index, set, question.k, question.max_distance_m));
      };
      enter("nanomap", fixture->view.index());
      for (const IndexFixture::Indexed& reference : fixture->references) {
        const bool has_no_radius =
            question.max_distance_m < NearestPointIndex::kAnyDistance && reference.name == "flann15";
        if (!has_no_radius) enter(reference.name, *reference.index);
      }
      contests.push_back(std::move(contest));
    }
  }
  return contests;
}

std::vector<Contest> sizeContests(Fixture small, Fixture large) {
  const auto pixels = [](const Fixture& fixture) { return static_cast<double>(fixture->camera->pixelCount()); };
  std::vector<Contest> contests{{.name = "build_pixel",
                                 .contestants = {builder(small, "nanomap_320x240", pixels(small)),
                                                 builder(large, "nanomap_848x480", pixels(large))},
                                 .ratings = {{"build_pixel_848x480/build_pixel_320x240", "nanomap_848x480"}}}};
  for (std::size_t i = 0; i < small->sets.size(); ++i) {
    const auto ask = [i](const Fixture& fixture, const char* name) {
      return asker(fixture, name, fixture->view.index(), fixture->sets[i], 1, NearestPointIndex::kAnyDistance);
    };
    contests.push_back({.name = "size_k1_" + small->sets[i].name,
                        .contestants = {ask(small, "nanomap_320x240"), ask(large, "nanomap_848x480")},
                        .ratings = {{"query_848x480/query_320x240", "nanomap_848x480"}}});
  }
  return contests;
}

}  // namespace nanomap::bench
