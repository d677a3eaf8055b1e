#include "tests/bench/rows/chain_fixture.h"

#include <utility>
#include <variant>

namespace nanomap::bench {
namespace {

/// Views held beyond the history: one in each chain that a last frame was inserted into, and the one being built.
constexpr std::size_t kSpareViews = 8;

}  // namespace

ChainFixture::ChainFixture(const RecordedFlight& recorded, std::size_t history)
    : flight(recorded),
      pool(std::make_shared<ViewPool>(flight.camera, IndexKind::kImage, history + kSpareViews)),
      before(chainOf(flight, history, flight.frames.size() - 1, *pool)) {
  Chain chain = before;
  insertLast(chain, after);
  edges = chain.edges();
}

void ChainFixture::insertLast(Chain& chain, ChainSnapshot& out) const {
  (void)chain.addPose(flight.poses.back());
  (void)chain.addView(std::get<ViewPtr>(pool->build(flight.frames.back())));
  chain.snapshotInto(out);
}

std::span<const DepthImage> ChainFixture::frames() const { return std::span(flight.frames).last(after.views.size()); }

std::shared_ptr<SequentialChain> ChainFixture::sequential(Trees trees, const TreeBuilder& build) const {
  std::vector<IndexedFrame> newest_first;
  for (std::size_t i = 0; i < after.views.size(); ++i) {
    const DepthImage& image = *(frames().rbegin() + static_cast<std::ptrdiff_t>(i));
    const bool indexed = i == 0 || trees == Trees::kOfEveryFrame;
    newest_first.push_back(
        {&image, flight.camera.get(), indexed ? build(image, *flight.camera) : std::unique_ptr<NearestPointIndex>()});
  }
  return std::make_shared<SequentialChain>(edges, std::move(newest_first));
}

}  // namespace nanomap::bench
