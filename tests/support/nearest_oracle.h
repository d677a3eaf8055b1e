#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/tile_grid.h"

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

/// In the float arithmetic that every index must follow.
inline float squaredDistance(const Vec3f& a, const Vec3f& b) {
  float sum = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float difference = a[axis] - b[axis];
    sum += difference * difference;
  }
  return sum;
}

/// Distances from `p_C` to all points, ascending.
inline std::vector<float> bruteForce(const std::vector<Vec3f>& points_C, const Vec3f& p_C) {
  std::vector<float> distances_m;
  distances_m.reserve(points_C.size());
  for (const Vec3f& point_C : points_C) distances_m.push_back(std::sqrt(squaredDistance(p_C, point_C)));
  std::sort(distances_m.begin(), distances_m.end());
  return distances_m;
}

/// The k nearest points; of equally distant ones, those of earlier tiles, and of earlier pixels of a tile, first.
inline std::vector<Vec3f> nearestInTileOrder(const DepthImage& image, const CameraModel& camera, const Vec3f& p_C,
                                             std::size_t k) {
  const TileGrid grid{camera.width(), camera.height()};
  std::vector<std::tuple<float, std::size_t, std::size_t, std::size_t>> order;  // by distance, tile, place
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (camera.classify(image.pixels[i]) != DepthReading::kInRange) continue;
    const auto u = static_cast<int>(i) % grid.width_px;
    const auto v = static_cast<int>(i) / grid.width_px;
    order.emplace_back(squaredDistance(p_C, camera.deproject(i, image.pixels[i])), grid.tileAt(u, v),
                       TileGrid::placeInTile(u, v), i);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), k));
  std::vector<Vec3f> nearest_C;
  for (const auto& [distance_sq_m2, tile, place, i] : order) {
    nearest_C.push_back(camera.deproject(i, image.pixels[i]));
  }
  return nearest_C;
}

}  // namespace nanomap::test
