#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/time.h"

namespace nanomap {

/// One organised 16-bit depth frame as it was measured.
struct DepthImage {
  Time stamp{};                ///< start of exposure
  std::uint64_t sequence = 0;  ///< the source's own count
  int width_px = 0;
  int height_px = 0;
  double depth_unit_m = 0.001;        ///< metres per count
  std::vector<std::uint16_t> pixels;  ///< row-major, width * height
};

}  // namespace nanomap
