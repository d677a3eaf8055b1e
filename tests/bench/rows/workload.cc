#include "tests/bench/rows/workload.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/flann_index.h"
#include "tests/bench/points/body_points.h"
#include "tests/bench/rows/correction_contest.h"
#include "tests/bench/rows/exactness.h"
#include "tests/bench/rows/index_contests.h"
#include "tests/bench/rows/memory.h"
#ifdef NANOMAP_BENCH_OCTOMAP
#include "tests/bench/rows/fused_grid_times.h"
#endif

namespace nanomap::bench {
namespace {

/// The leaf size with which nanoflann builds a frame and answers a plan's queries soonest.
int bestCycleLeaf(const IndexFixture& index, std::size_t queries) {
  constexpr int kTries = 3;
  int best_leaf = kNanoflannLeaves.front();
  double best_s = std::numeric_limits<double>::infinity();
  const std::vector<Vec3f>& points_C = index.sets.front().points_C;
  for (int i = 0; i < kTries; ++i) {
    for (const int leaf : kNanoflannLeaves) {
      const double start_s = threadTime_s();
      const auto tree = buildNanoflannIndex(index.image, *index.camera, leaf);
      Neighbour nearest;
      for (std::size_t query = 0; query < queries; ++query) {
        (void)tree->nearest(points_C[query % points_C.size()], std::span(&nearest, 1));
      }
      const double time_s = threadTime_s() - start_s;
      if (time_s >= best_s) continue;
      best_s = time_s;
      best_leaf = leaf;
    }
  }
  return best_leaf;
}

}  // namespace

Workload::Workload(Scenario scenario, const Effort& effort)
    : scenario_(std::move(scenario)),
      effort_(effort),
      index_(std::make_shared<IndexFixture>(scenario_.flight, effort_.nearest_queries, IndexFixture::References::kAll)),
      chain_(std::make_shared<ChainFixture>(scenario_.flight, scenario_.history)) {
  cycle_leaf_ = bestCycleLeaf(*index_, effort_.plan_queries);
  if (scenario_.wide) {
    wide_index_ =
        std::make_shared<IndexFixture>(*scenario_.wide, effort_.nearest_queries, IndexFixture::References::kNone);
  }
  if (scenario_.hover) hover_ = std::make_shared<ChainFixture>(*scenario_.hover, scenario_.history);
  addDepths();
  plans_ = std::make_unique<PlanTimes>(chain_, effort_.plans);
}

std::vector<Walker> Workload::walkers(const ChainFixture& chain, ChainFixture::Trees trees) const {
  const TreeBuilder nanoflann = [leaf = cycle_leaf_](const DepthImage& image, const CameraModel& camera) {
    return buildNanoflannIndex(image, camera, leaf);
  };
  return {{"nanoflann", nanoflann, chain.sequential(trees, nanoflann)},
          {"flann15", buildFlannIndex, chain.sequential(trees, buildFlannIndex)}};
}

void Workload::addDepths() {
  const auto add = [](std::vector<Depth>& to, std::string name, const auto& chain, const auto& walkers,
                      std::vector<UncertainPoint> points_B) {
    if (points_B.empty()) return;
    to.push_back(
        {std::move(name), chain, walkers, std::make_shared<const std::vector<UncertainPoint>>(std::move(points_B))});
  };
  const auto pointsOf = [](const ChainFixture& chain, const std::vector<Walker>& walkers) {
    return BodyPoints(chain.after, chain.frames(),
                      [walk = walkers.front().chain](const UncertainPoint& x_B) { return walk->locate(x_B); });
  };
  const std::size_t count = effort_.plan_queries;

  const std::vector<Walker> flown = walkers(*chain_, ChainFixture::Trees::kOfEveryFrame);
  const BodyPoints points = pointsOf(*chain_, flown);
  const std::size_t views = chain_->after.views.size();
  std::vector<UncertainPoint> mixed = points.answeredBy(0, 1, count);
  if (const auto deeper = points.answeredBy(1, views, count); deeper.empty()) {
    mixed.clear();
  } else {
    constexpr std::size_t kQuarter = 4;
    for (std::size_t i = 0; i < mixed.size(); i += kQuarter) mixed[i] = deeper[i];
  }
  add(cycles_, "cycle_75_percent_current", chain_, flown, std::move(mixed));
  add(cycles_, "cycle_100_views_deep", chain_, flown, points.answeredBy(views * 2 / 3, views, count));
  const std::vector<UncertainPoint> in_no_view = points.inNoView(count);
  add(cycles_, "cycle_in_no_view", chain_, flown, in_no_view);
  add(searches_, "in_none_of_150_views", chain_, flown, in_no_view);

  if (!hover_) return;
  const std::vector<Walker> hovered = walkers(*hover_, ChainFixture::Trees::kOfNewestFrame);
  const std::vector<UncertainPoint> occluded = pointsOf(*hover_, hovered).occludedInEveryView(count);
  add(cycles_, "cycle_occluded", hover_, hovered, occluded);
  add(searches_, "occluded_in_150_views", hover_, hovered, occluded);
}

std::vector<Contest> Workload::contests() const {
  std::vector<Contest> contests = contestsWithReference();
  contests.push_back(plans_->contest());
  return contests;
}

std::vector<Contest> Workload::contestsWithReference() const {
  std::vector<Contest> contests = {buildContest(index_), correctionContest(chain_)};
  const auto append = [&contests](std::vector<Contest> more) { std::ranges::move(more, std::back_inserter(contests)); };
  append(nearestContests(index_, scenario_.noise));
  if (wide_index_) append(sizeContests(index_, wide_index_));
  for (const Depth& depth : searches_) {
    contests.push_back(locateContest(depth.chain, depth.walkers.front(), depth.name, depth.points_B));
  }
  for (const Depth& depth : cycles_) {
    contests.push_back(cycleContest(depth.chain, depth.walkers, depth.name, depth.points_B));
  }
  return contests;
}

void Workload::measure(Scoreboard& scoreboard) const {
  const std::string& where = scenario_.name;
  for (const Contest& contest : contestsWithReference()) {
    scoreboard.record(contest, hold(contest, contest.is_long ? effort_.long_rounds : effort_.rounds), where);
  }
  for (const Depth& depth : cycles_) {
    for (const Walker& walker : depth.walkers) {
      scoreboard.rate("views_that_differ", static_cast<double>(countDifferences(*depth.chain, walker, *depth.points_B)),
                      where + " " + depth.name + " " + walker.name);
    }
#ifdef NANOMAP_BENCH_OCTOMAP
    if (depth.name == "cycle_75_percent_current") timeFusedGrid(*depth.chain, *depth.points_B, scoreboard, where);
#endif
  }
  rateExactness(*index_, effort_.checked_queries, scoreboard, where);
  if (wide_index_) rateExactness(*wide_index_, effort_.checked_queries / 4, scoreboard, where + " 848x480");
  plans_->rate(scoreboard, effort_.long_rounds, where);
  rateMemory(scenario_.flight, scenario_.history, scoreboard, where);
  scoreboard.remark(fmt::format("{}: nanoflann's best leaf for a cycle is {}", where, cycle_leaf_));
}

}  // namespace nanomap::bench
