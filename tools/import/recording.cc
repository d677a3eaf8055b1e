#include "tools/import/recording.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace nanomap {

Recording select(Recording recording, std::size_t every, std::size_t max_images) {
  assert(every > 0);
  std::vector<RecordedImage> images;
  for (std::size_t i = 0; i < recording.images.size() && images.size() < max_images; i += every) {
    images.push_back(std::move(recording.images[i]));
  }
  recording.images = std::move(images);
  if (recording.images.empty()) return {};

  const auto last = std::ranges::lower_bound(recording.poses, recording.images.back().stamp, {}, &RecordedPose::stamp);
  if (last != recording.poses.end()) recording.poses.erase(std::next(last), recording.poses.end());
  return recording;
}

}  // namespace nanomap
