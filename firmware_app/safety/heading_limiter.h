#pragma once

#include <optional>

#include "core/time.h"

namespace nanomap {

/// A heading that follows another no faster than the vehicle should turn, the shorter way round. Threads: one.
class HeadingLimiter {
 public:
  explicit HeadingLimiter(double max_rate_rad_s) : max_rate_rad_s_(max_rate_rad_s) {}

  /// Begins anew, at this heading.
  void reset(Time now, double yaw_rad);

  /// The heading at `now`, on its way to `wanted_rad`. The first one after none is the wanted one.
  [[nodiscard]] double follow(Time now, double wanted_rad);

 private:
  struct Heading {
    Time stamp{};
    double yaw_rad = 0.0;
  };

  double max_rate_rad_s_;
  std::optional<Heading> last_;
};

}  // namespace nanomap
