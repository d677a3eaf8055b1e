#include "core/query_statistics.h"

#include <algorithm>
#include <numeric>

namespace nanomap {

void QueryStatistics::record(const QueryReply& reply) {
  ++total_;
  ++by_status_[static_cast<std::size_t>(reply.status)];
  const bool contained = reply.status == Status::kFree || reply.status == Status::kOpen;
  if (contained && *reply.view_index < contained_at_depth_.size()) ++contained_at_depth_[*reply.view_index];
}

double QueryStatistics::shareContainedWithin(std::size_t views) const {
  if (total_ == 0) return 0.0;
  const auto end =
      contained_at_depth_.begin() + static_cast<std::ptrdiff_t>(std::min(views, contained_at_depth_.size()));
  return static_cast<double>(std::accumulate(contained_at_depth_.begin(), end, std::uint64_t{0})) /
         static_cast<double>(total_);
}

}  // namespace nanomap
