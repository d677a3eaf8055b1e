#include "core/query.h"

#include <cassert>

namespace nanomap {

Location locate(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options) {
  if (snapshot.views.empty()) return {};
  const Location newest{classify(snapshot.views.front(), x_B, options), 0};
  if (endsSearch(newest.status)) return newest;
  ViewFilter::Walk candidates(snapshot.filter, snapshot.views.size(), x_B, 1);
  while (const auto i = candidates.next()) {
    const Status status = classify(snapshot.views[*i], x_B, options);
    if (endsSearch(status)) return {status, i};
  }
  return newest;
}

QueryReply query(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options) {
  assert(options.k >= 1 && options.k <= kMaxNeighbours);
  QueryReply reply;
  const Location location = locate(snapshot, x_B, options);
  reply.status = location.status;
  reply.view_index = location.view_index;
  if (!location.view_index) return reply;

  const SnapshotView& view = snapshot.views[*location.view_index];
  reply.x_C = view.toCamera(x_B);
  reply.neighbour_count = static_cast<std::uint32_t>(view.view->index().nearest(
      reply.x_C.mean_m.cast<float>(), std::span(reply.neighbours).first(static_cast<std::size_t>(options.k))));
  return reply;
}

void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                std::span<QueryReply> replies) {
  assert(points_B.size() == replies.size());
  for (std::size_t i = 0; i < points_B.size(); ++i) replies[i] = query(snapshot, points_B[i], options);
}

}  // namespace nanomap
