#pragma once

#include <cstdint>

namespace nanomap {

/// Which body frame the orientation of bot_core.pose_t maps to the local frame, whose z is up in either case. The type
/// does not say, and robots differ: it is configured.
enum class BodyConvention : std::uint8_t {
  kFlu,  ///< x forward, y left, z up: NanoMap's own
  kFrd,  ///< x forward, y right, z down
};

}  // namespace nanomap
