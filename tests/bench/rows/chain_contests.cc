#include "tests/bench/rows/chain_contests.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/query.h"

namespace nanomap::bench {
namespace {

/// What one cycle of ours works on.
struct Cycle {
  Chain chain;
  ChainSnapshot snapshot;
  QueryScratch scratch;
  std::vector<QueryReply> replies;
};

}  // namespace

Contest locateContest(std::shared_ptr<const ChainFixture> fixture, const Walker& walker, const std::string& name,
                      BodyPointSet points_B) {
  const auto items = static_cast<double>(points_B->size());
  return {.name = name,
          .contestants = {{.name = "nanomap",
                           .items = items,
                           .run =
                               [fixture, points_B] {
                                 for (const UncertainPoint& x_B : *points_B) {
                                   benchmark::DoNotOptimize(locate(fixture->after, x_B, {}));
                                 }
                               }},
                          {.name = "walk",
                           .items = items,
                           .run =
                               [chain = walker.chain, points_B] {
                                 for (const UncertainPoint& x_B : *points_B) {
                                   benchmark::DoNotOptimize(chain->locate(x_B));
                                 }
                               }}},
          .ratings = {{name + "/walk", "walk"}},
          .is_long = true};
}

Contest cycleContest(std::shared_ptr<const ChainFixture> fixture, const std::vector<Walker>& walkers,
                     const std::string& name, BodyPointSet points_B) {
  const auto cycle = std::make_shared<Cycle>(Cycle{fixture->before, {}, {}, std::vector<QueryReply>(points_B->size())});
  Contest contest{.name = name,
                  .contestants = {{.name = "nanomap",
                                   .run =
                                       [fixture, points_B, cycle] {
                                         fixture->insertLast(cycle->chain, cycle->snapshot);
                                         queryBatch(cycle->snapshot, *points_B, {}, cycle->scratch, cycle->replies);
                                       },
                                   .prepare = [fixture, cycle] { cycle->chain = fixture->before; }}},
                  .ratings = {},
                  .is_long = true};
  for (const Walker& walker : walkers) {
    contest.contestants.push_back({.name = walker.name, .run = [fixture, walker, points_B] {
                                     const DepthImage& image = fixture->flight.frames.back();
                                     const CameraModel& camera = *fixture->flight.camera;
                                     walker.chain->replaceNewest({&image, &camera, walker.build(image, camera)});
                                     for (const UncertainPoint& x_B : *points_B) {
                                       benchmark::DoNotOptimize(walker.chain->query(x_B, 1));
                                     }
                                   }});
    contest.ratings.push_back({name + "/" + walker.name, walker.name});
  }
  return contest;
}

std::size_t countDifferences(const ChainFixture& fixture, const Walker& walker,
                             const std::vector<UncertainPoint>& points_B) {
  // Composing edges in another order moves a point by some 1e-14 m, which can move its rounding to float by a step.
  constexpr float kStep_m = 4e-6F;
  const auto differs = [&](const UncertainPoint& x_B) {
    const QueryReply ours = query(fixture.after, x_B, {});
    const SequentialChain::Answer theirs = walker.chain->query(x_B, 1);
    const bool free = ours.status == Status::kFree;
    if (free != theirs.view.has_value() || (free && ours.view_index != theirs.view)) return true;
    if (ours.neighbour_count != theirs.neighbour_count) return true;
    return ours.neighbour_count > 0 &&
           std::abs(ours.neighbours[0].distance_m - theirs.neighbours[0].distance_m) > kStep_m;
  };
  return static_cast<std::size_t>(std::ranges::count_if(points_B, differs));
}

}  // namespace nanomap::bench
