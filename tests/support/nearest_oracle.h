#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"

namespace nanomap::test {

/// The points that an index of `image` must hold.
inline std::vector<Vec3f> pointsInRange(const DepthImage& image, const CameraModel& camera) {
  std::vector<Vec3f> points_C;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (camera.classify(image.pixels[i]) != DepthReading::kInRange) continue;
    points_C.push_back(camera.deproject(i, image.pixels[i]));
  }
  return points_C;
}

/// Distances from `p_C` to all points, ascending, in the float arithmetic that every index must follow.
inline std::vector<float> bruteForce(const std::vector<Vec3f>& points_C, const Vec3f& p_C) {
  std::vector<float> distances_m;
  distances_m.reserve(points_C.size());
  for (const Vec3f& point_C : points_C) {
    float sum = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float difference = p_C[axis] - point_C[axis];
      sum += difference * difference;
    }
    distances_m.push_back(std::sqrt(sum));
  }
  std::sort(distances_m.begin(), distances_m.end());
  return distances_m;
}

}  // namespace nanomap::test
