#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "core/query.h"
#include "tests/bench/recorded_flight.h"

namespace nanomap::bench {
namespace {

constexpr std::size_t kHistory = 150;
constexpr std::size_t kPlanQueries = 125 * 20;
constexpr unsigned kSeed = 5;

const RecordedFlight& flight() {
  static const RecordedFlight instance = recordFlight(kHistory);
  return instance;
}

const ChainSnapshot& snapshot() {
  static const ChainSnapshot instance = chainOf(flight()).snapshot();
  return instance;
}

/// Points whose answer meets `wanted`, drawn around the vehicle.
template <class Predicate>
std::vector<UncertainPoint> draw(std::size_t count, Predicate&& wanted) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> coordinate(-12.0, 12.0);
  std::vector<UncertainPoint> points_B;
  while (points_B.size() < count) {
    const UncertainPoint x_B{{coordinate(random), coordinate(random), coordinate(random) / 4.0},
                             0.01 * Mat3::Identity()};
    if (wanted(query(snapshot(), x_B, {}))) points_B.push_back(x_B);
  }
  return points_B;
}

bool inCurrentView(const QueryReply& reply) { return reply.status == Status::kFree && reply.view_index == 0U; }
bool deeper(const QueryReply& reply) { return reply.status == Status::kFree && *reply.view_index > 0; }
bool inNoView(const QueryReply& reply) { return reply.status != Status::kFree && reply.status != Status::kOpen; }

void runQueries(benchmark::State& state, const std::vector<UncertainPoint>& points_B, const QueryOptions& options) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query(snapshot(), points_B[i], options));
    i = i + 1 == points_B.size() ? 0 : i + 1;
  }
}

void buildViewFromImage(benchmark::State& state) {
  const RecordedFlight& recorded = flight();
  for (auto _ : state) benchmark::DoNotOptimize(buildView(recorded.frames.front(), recorded.camera));
}
BENCHMARK(buildViewFromImage)->Unit(benchmark::kMillisecond);

/// A built view into a full chain, and the pose that follows it.
void insertView(benchmark::State& state) {
  Chain chain = chainOf(flight());
  ChainSnapshot out;
  Time stamp = flight().poses.back().stamp;
  BodyPose pose = flight().poses.back();
  for (auto _ : state) {
    state.PauseTiming();
    stamp += std::chrono::milliseconds(10);
    DepthImage empty = flight().frames.front();
    empty.stamp = stamp;
    auto view = std::make_shared<const View>(std::move(empty), flight().camera, nullptr);
    pose.stamp = stamp;
    state.ResumeTiming();
    (void)chain.addPose(pose);
    (void)chain.addView(std::move(view));
    chain.snapshotInto(out);
  }
}
BENCHMARK(insertView)->Unit(benchmark::kMicrosecond);

void queryInCurrentView(benchmark::State& state) {
  static const std::vector<UncertainPoint> points_B = draw(1000, inCurrentView);
  runQueries(state, points_B, {.k = static_cast<int>(state.range(0))});
}
BENCHMARK(queryInCurrentView)->Arg(1)->Arg(10);

void queryThatNoneOf150ViewsContains(benchmark::State& state) {
  static const std::vector<UncertainPoint> points_B = draw(1000, inNoView);
  runQueries(state, points_B, {.k = static_cast<int>(state.range(0))});
}
BENCHMARK(queryThatNoneOf150ViewsContains)->Arg(1)->Arg(10);

/// One plan's worth of queries, three quarters of them in the current view (paper IV.B), the rest deeper.
void planOf2500Queries(benchmark::State& state) {
  static const std::vector<UncertainPoint> points_B = [] {
    std::vector<UncertainPoint> points = draw(kPlanQueries * 3 / 4, inCurrentView);
    const std::vector<UncertainPoint> others = draw(kPlanQueries - points.size(), deeper);
    points.insert(points.end(), others.begin(), others.end());
    return points;
  }();
  std::vector<QueryReply> replies(points_B.size());
  for (auto _ : state) {
    queryBatch(snapshot(), points_B, {}, replies);
    benchmark::DoNotOptimize(replies.data());
  }
}
BENCHMARK(planOf2500Queries)->Unit(benchmark::kMillisecond);

/// A window over the whole history, a corrected pose a view.
void correct150Poses(benchmark::State& state) {
  Chain chain = chainOf(flight());
  Correction correction;
  for (const DepthImage& frame : flight().frames) {
    const PoseBuffer::Lookup original = chain.poses().interpolate(frame.stamp);
    correction.poses.push_back({frame.stamp, Pose{Quat::Identity(), Vec3(0.1, 0.0, 0.0)} * original.T_W_B});
  }
  for (auto _ : state) {
    ++correction.sequence;
    benchmark::DoNotOptimize(chain.addCorrection(correction));
  }
  if (chain.counters().edges_corrected == 0) state.SkipWithError("no edge was corrected");
}
BENCHMARK(correct150Poses)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace nanomap::bench

BENCHMARK_MAIN();
