#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/query.h"

namespace nanomap {

/// How far back queries were answered (the paper's "74.4 % within the current field of view, 92.3 % within the last
/// 40 measurements"), and with which status. Threads: one.
class QueryStatistics {
 public:
  /// Allocates for depths 0 .. history_views - 1.
  explicit QueryStatistics(std::size_t history_views) : contained_at_depth_(history_views, 0) {}

  void record(const QueryReply& reply);

  [[nodiscard]] std::uint64_t total() const { return total_; }
  [[nodiscard]] std::uint64_t withStatus(Status status) const { return by_status_[static_cast<std::size_t>(status)]; }

  /// Queries contained (kFree or kOpen) by the view `depth` behind the newest.
  [[nodiscard]] const std::vector<std::uint64_t>& containedAtDepth() const { return contained_at_depth_; }

  /// Share of all queries that the newest `views` views contained, 0 .. 1; 0 before any query.
  [[nodiscard]] double shareContainedWithin(std::size_t views) const;

 private:
  std::uint64_t total_ = 0;
  std::array<std::uint64_t, kStatusCount> by_status_{};
  std::vector<std::uint64_t> contained_at_depth_;
};

}  // namespace nanomap
