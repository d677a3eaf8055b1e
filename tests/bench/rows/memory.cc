#include "tests/bench/rows/memory.h"

#include <fmt/format.h>
#include <malloc.h>

#include <memory>

#include "core/chain.h"
#include "core/flann_index.h"
#include "core/view_pool.h"
#include "tests/bench/references/nanoflann_index.h"

namespace nanomap::bench {
namespace {

constexpr double kBytesPerMb = 1e6;

/// Bytes in use, what the allocator adds to each piece included.
std::size_t heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Heap that `make()` leaves in use as long as its result lives.
template <class Make>
double heapOf_mb(Make&& make) {
  const std::size_t before = heapBytes();
  const auto made = make();
  return static_cast<double>(heapBytes() - before) / kBytesPerMb;
}

struct History {
  RecordedFlight flight;  ///< without frames, which the views replace
  ViewPool pool;
  Chain chain;
  ChainSnapshot snapshot;
};

}  // namespace

void rateMemory(const RecordedFlight& flight, std::size_t history, Scoreboard& scoreboard, const std::string& where) {
  const double ours_mb = heapOf_mb([&] {
    const auto camera = std::make_shared<const CameraModel>(flight.camera->parameters());
    ViewPool pool(camera, IndexKind::kImage, history);
    Chain chain = chainOf(flight, history, history, pool);
    ChainSnapshot snapshot = chain.snapshot();
    return History{{camera, {}, {}}, std::move(pool), std::move(chain), std::move(snapshot)};
  });
  scoreboard.rate("memory_of_150_views_mb", ours_mb, where);

  const DepthImage& image = flight.frames.back();
  const double image_mb = static_cast<double>(image.pixels.size() * sizeof(std::uint16_t)) / kBytesPerMb;
  const auto remark = [&](const char* name, double tree_mb) {
    scoreboard.remark(fmt::format("{}: {} views with {} take {:.0f} MB", where, history, name,
                                  static_cast<double>(history) * (image_mb + tree_mb)));
  };
  remark("flann15", heapOf_mb([&] { return buildFlannIndex(image, *flight.camera); }));
  remark("nanoflann10", heapOf_mb([&] { return buildNanoflannIndex(image, *flight.camera, 10); }));
}

}  // namespace nanomap::bench
