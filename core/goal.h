#pragma once

#include <cstdint>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// Where to fly, and how fast at most.
struct Goal {
  Time stamp{};
  std::uint64_t sequence = 0;
  std::uint32_t epoch = 0;  ///< of the world that the position is given in
  Vec3 position_W_m = Vec3::Zero();
  double top_speed_m_s = 0.0;  ///< soft limit; positive in a valid goal
};

}  // namespace nanomap
