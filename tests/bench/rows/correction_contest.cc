#include "tests/bench/rows/correction_contest.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/correction.h"
#include "tests/bench/references/slerp_correction.h"

namespace nanomap::bench {
namespace {

/// In one run: one takes microseconds, and what else the machine does would tip a run as short as ten.
constexpr int kRepeats = 200;

/// Poses that drift away from the original ones, slowly, from just before the first view to just after the last.
Correction driftingWindow(const ChainFixture& fixture, const PoseBuffer& poses) {
  constexpr Duration kMargin = std::chrono::milliseconds(5);
  constexpr double kDrift_m = 0.001;
  constexpr double kDrift_rad = 0.0001;
  const Time first = fixture.frames().front().stamp - kMargin;
  const Duration span = fixture.frames().back().stamp + kMargin - first;
  const auto count = static_cast<std::int64_t>(fixture.frames().size());
  Correction correction;
  for (std::int64_t i = 0; i < count; ++i) {
    const Time stamp = first + span * i / (count - 1);
    const PoseBuffer::Lookup original = poses.interpolate(stamp);
    if (original.status != PoseBuffer::LookupStatus::kFound) throw std::runtime_error("no pose around a depth frame");
    const auto drift = static_cast<double>(i);
    const Pose T_Wnew_W{Quat(Eigen::AngleAxisd(drift * kDrift_rad, Vec3::UnitZ())), {drift * kDrift_m, 0.0, 0.0}};
    correction.poses.push_back({stamp, T_Wnew_W * original.T_W_B});
  }
  return correction;
}

struct Corrected {
  Chain chain;
  Correction correction;
  SlerpCorrection slerp;
};

}  // namespace

Contest correctionContest(std::shared_ptr<const ChainFixture> fixture) {
  std::vector<Time> stamps;
  for (const SnapshotView& view : fixture->after.views) stamps.push_back(view.view->stamp());
  Chain chain = fixture->before;
  ChainSnapshot unused;
  fixture->insertLast(chain, unused);
  const Correction window = driftingWindow(*fixture, chain.poses());
  const auto corrected = std::make_shared<Corrected>(Corrected{
      std::move(chain), window, SlerpCorrection(std::move(stamps), fixture->flight.camera->parameters().T_B_C)});

  const auto contestant = [&](const char* name, auto apply) {
    return Contestant{.name = name, .items = kRepeats, .run = [fixture, corrected, apply] {
                        for (int i = 0; i < kRepeats; ++i) apply(*corrected);
                        benchmark::ClobberMemory();
                      }};
  };
  return {.name = "correct_150_poses",
          .contestants = {contestant("nanomap",
                                     [](Corrected& c) {
                                       ++c.correction.sequence;
                                       benchmark::DoNotOptimize(c.chain.addCorrection(c.correction));
                                     }),
                          contestant("slerp_edge_by_edge", [](Corrected& c) { c.slerp.applyEdgeByEdge(c.correction); }),
                          contestant("once_a_view", [](Corrected& c) { c.slerp.applyViewByView(c.correction); })},
          .ratings = {{"correct_150_poses/slerp", "slerp_edge_by_edge"}}};
}

}  // namespace nanomap::bench
