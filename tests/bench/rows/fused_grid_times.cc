#include "tests/bench/rows/fused_grid_times.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>

#include "tests/bench/references/fused_grid.h"
#include "tools/replay/percentile.h"

namespace nanomap::bench {

void timeFusedGrid(const ChainFixture& fixture, const std::vector<UncertainPoint>& points_B, Scoreboard& scoreboard,
                   const std::string& where) {
  constexpr std::size_t kFrames = 4;
  const Pose& T_W_B = fixture.after.T_W_B;
  FusedGrid grid(T_W_B.translation_m);
  std::vector<double> times_s;
  const std::span<const DepthImage> frames = fixture.frames();
  for (const DepthImage& image : frames.last(std::min(kFrames, frames.size()))) {
    const Pose T_W_Bframe = fixture.before.poses().interpolate(image.stamp).T_W_B;
    const double start_s = threadTime_s();
    grid.insert(image, *fixture.flight.camera, T_W_Bframe);
    for (const UncertainPoint& x_B : points_B) benchmark::DoNotOptimize(grid.distance_m(T_W_B * x_B.mean_m));
    times_s.push_back(threadTime_s() - start_s);
  }
  times_s.erase(times_s.begin());  // the first one makes the grid
  if (times_s.empty()) return;
  scoreboard.recordTime("cycle_75_percent_current", "octomap_fused_grid", where, percentile<double>(times_s, 0.5));
}

}  // namespace nanomap::bench
