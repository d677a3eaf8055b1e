#pragma once

#include <filesystem>

#include "tools/import/recording.h"

namespace nanomap {

/// What a count of this layout's images is, unless a recording says otherwise: millimetres.
inline constexpr double kNumberedDepthUnit_m = 0.001;

/// A folder of `NNNNNN.depth.png`, each with its `NNNNNN.pose.txt`: a 4x4 camera-to-world matrix. It carries no
/// stamps: frame number n is taken n / `rate_hz` seconds after zero.
/// @throws std::runtime_error naming the file: no images, a missing pose, two files with one number, a matrix that is
///         not finite or not a rigid transform
/// @pre rate_hz > 0
[[nodiscard]] Recording readNumberedLayout(const std::filesystem::path& folder, double rate_hz);

}  // namespace nanomap
