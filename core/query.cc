#include "core/query.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace nanomap {

Location locate(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options) {
  if (snapshot.views.empty()) return {};
  const Location newest{classify(snapshot.views.front(), x_B, options), 0};
  if (endsSearch(newest.status)) return newest;
  ViewFilter::Walk candidates(snapshot.filter, snapshot.views.size(), x_B, options, 1);
  while (const auto i = candidates.next()) {
    if (candidates.isBeforeHole()) continue;
    const Status status = classify(snapshot.views[*i], x_B, options);
    if (endsSearch(status)) return {status, i};
  }
  return newest;
}

std::optional<std::uint32_t> newestHolding(const ChainSnapshot& snapshot, const Vec3& mean_B_m, std::uint32_t count) {
  assert(count <= snapshot.views.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const SnapshotView& view = snapshot.views[i];
    const Vec3 mean_C_m = view.R_C_B * mean_B_m + view.t_C_B_m;
    if (contains(view.view->camera().frustum(), mean_C_m, Vec3::Zero())) return i;
  }
  return std::nullopt;
}

namespace {

/// nearestAt(), written where the reply is wanted.
void answerAt(const ChainSnapshot& snapshot, const Location& location, const UncertainPoint& x_B,
              const QueryOptions& options, float max_distance_m, QueryReply& reply) {
  assert(options.k >= 1 && options.k <= kMaxNeighbours);
  reply.status = location.status;
  reply.view_index = location.view_index;
  reply.certified.reset();
  if (options.certify) {
    reply.certified = certifiedClearance(snapshot, x_B.mean_m, options, static_cast<double>(max_distance_m));
  }
  reply.neighbour_count = 0;
  if (!location.view_index) {
    reply.x_C = {};
    return;
  }

  const SnapshotView& view = snapshot.views[*location.view_index];
  reply.x_C = view.toCamera(x_B);
  const auto wanted = std::span(reply.neighbours).first(static_cast<std::size_t>(options.k));
  reply.neighbour_count =
      static_cast<std::uint32_t>(view.view->index().nearest(reply.x_C.mean_m.cast<float>(), wanted, max_distance_m));
  if (reply.certified && reply.neighbour_count > 0) {
    const auto nearest_m = static_cast<double>(reply.neighbours.front().distance_m);
    reply.certified->radius_m = std::min(reply.certified->radius_m, nearest_m);
  }
}

}  // namespace

QueryReply nearestAt(const ChainSnapshot& snapshot, const Location& location, const UncertainPoint& x_B,
                     const QueryOptions& options, float max_distance_m) {
  QueryReply reply;
  answerAt(snapshot, location, x_B, options, max_distance_m, reply);
  return reply;
}

QueryReply query(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options) {
  return nearestAt(snapshot, locate(snapshot, x_B, options), x_B, options);
}

std::span<Location> QueryScratch::locations(std::size_t count) {
  locations_.resize(std::max(locations_.size(), count));
  return std::span(locations_).first(count);
}

/// Counting sort, stable.
std::span<const std::uint32_t> QueryScratch::orderByView(std::span<const Location> locations, std::size_t view_count) {
  const auto viewOf = [](const Location& location) { return location.view_index.value_or(0); };
  first_of_view_.assign(view_count + 1, 0);
  for (const Location& location : locations) ++first_of_view_[viewOf(location) + 1];
  std::partial_sum(first_of_view_.begin(), first_of_view_.end(), first_of_view_.begin());
  order_.resize(std::max(order_.size(), locations.size()));
  for (std::uint32_t i = 0; i < locations.size(); ++i) order_[first_of_view_[viewOf(locations[i])]++] = i;
  return std::span(order_).first(locations.size());
}

void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                QueryScratch& scratch, std::span<QueryReply> replies, std::span<const float> max_distances_m) {
  assert(points_B.size() == replies.size());
  assert(max_distances_m.empty() || max_distances_m.size() == points_B.size());
  const std::span<Location> locations = scratch.locations(points_B.size());
  for (std::size_t i = 0; i < points_B.size(); ++i) locations[i] = locate(snapshot, points_B[i], options);
  for (const std::uint32_t i : scratch.orderByView(locations, std::max<std::size_t>(snapshot.views.size(), 1))) {
    const float max_distance_m = max_distances_m.empty() ? NearestPointIndex::kAnyDistance : max_distances_m[i];
    answerAt(snapshot, locations[i], points_B[i], options, max_distance_m, replies[i]);
  }
}

void queryBatch(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B, const QueryOptions& options,
                std::span<QueryReply> replies) {
  QueryScratch scratch;
  queryBatch(snapshot, points_B, options, scratch, replies);
}

}  // namespace nanomap
