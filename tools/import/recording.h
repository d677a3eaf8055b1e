#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// Pose of the camera (RDF) in the recording's world.
struct RecordedPose {
  Time stamp{};
  Pose T_W_C;
};

struct RecordedImage {
  Time stamp{};
  std::uint64_t sequence = 0;
  std::filesystem::path file;
};

/// What a folder holds, each by increasing stamp. Images are read one at a time, when they are written.
struct Recording {
  std::vector<RecordedPose> poses;
  std::vector<RecordedImage> images;
};

/// Every `every`-th image from the first, at most `max_images` of them, and the poses up to one behind the last.
/// @pre every > 0
[[nodiscard]] Recording select(Recording recording, std::size_t every, std::size_t max_images);

}  // namespace nanomap
