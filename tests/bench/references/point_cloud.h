#pragma once

#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"

namespace nanomap::bench {

/// The returns of `image` in the camera's trusted range, in C, row-major.
[[nodiscard]] inline std::vector<Vec3f> pointCloud(const DepthImage& image, const CameraModel& camera) {
  std::vector<Vec3f> points_C;
  points_C.reserve(image.pixels.size());
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
    const std::uint16_t raw = image.pixels[pixel];
    if (camera.classify(raw) == DepthReading::kInRange) points_C.push_back(camera.deproject(pixel, raw));
  }
  return points_C;
}

}  // namespace nanomap::bench
