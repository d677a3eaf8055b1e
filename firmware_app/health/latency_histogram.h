#pragma once

#include <cstdint>
#include <memory>

#include "core/time.h"

namespace nanomap {

/// Distribution of one measured time, from 1 us to 10 s with a resolution of 2 %. What is beyond counts at the ends.
/// Threads: one. Allocates at construction.
class LatencyHistogram {
 public:
  LatencyHistogram();
  ~LatencyHistogram();
  LatencyHistogram(LatencyHistogram&&) noexcept;
  LatencyHistogram& operator=(LatencyHistogram&&) noexcept;

  void record(Duration latency);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The time that this share of all is not above; zero without any. @pre 0 <= share <= 1
  [[nodiscard]] Duration quantile(double share) const;
  [[nodiscard]] Duration max() const { return max_; }

 private:
  struct Bins;

  std::unique_ptr<Bins> bins_;
  std::uint64_t count_ = 0;
  Duration max_{};
};

}  // namespace nanomap
