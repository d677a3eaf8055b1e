#pragma once

#include <filesystem>

#include "tools/import/recording.h"

namespace nanomap {

/// What a count of the benchmark's images is: 5000 a metre.
inline constexpr double kTumDepthUnit_m = 1.0 / 5000.0;

/// The folder layout of the TUM RGB-D benchmark: `depth.txt` with lines `stamp file`, `groundtruth.txt` with lines
/// `stamp tx ty tz qx qy qz qw` of the camera in the world; stamps in seconds, `#` starts a comment line.
/// @throws std::runtime_error naming the file and line: a missing file, no records, a malformed number, a stamp that
///         does not increase, a quaternion that is not unit
[[nodiscard]] Recording readTumLayout(const std::filesystem::path& folder);

/// Whether `folder` holds the two files of this layout.
[[nodiscard]] bool isTumLayout(const std::filesystem::path& folder);

}  // namespace nanomap
