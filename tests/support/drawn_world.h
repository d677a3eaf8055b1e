#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/support/drawing.h"

namespace nanomap::test {

/// An upright box in W. Glass gives no depth, and none of what is behind it.
struct Block {
  Vec3 low_W = Vec3::Zero();
  Vec3 high_W = Vec3::Zero();
  bool glass = false;
};

/// Flat ground at z = 0 under an empty sky, and blocks on it. Seen by a perfect camera: one ray a pixel.
struct DrawnWorld {
  std::vector<Block> blocks;

  [[nodiscard]] DepthImage seenBy(const CameraModel& camera, const Pose& T_W_B, Time stamp) const {
    DepthImage image = flatImage(camera, 0, stamp);
    const Pose T_W_C = T_W_B * camera.parameters().T_B_C;
    for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
      const Eigen::Vector2f& tangents = camera.rayTangents(pixel);
      const Vec3 ray_W = T_W_C.rotation * Vec3(static_cast<double>(tangents.x()), static_cast<double>(tangents.y()), 1);
      const double counts = std::round(depthAlong(T_W_C.translation_m, ray_W) / image.depth_unit_m);
      if (counts > 0.0 && counts < 65535.0) image.pixels[pixel] = static_cast<std::uint16_t>(counts);
    }
    return image;
  }

  /// From p_W to the nearest block, or to the ground [m]; 0 inside.
  [[nodiscard]] double clearance_m(const Vec3& p_W) const {
    double nearest_m = std::max(p_W.z(), 0.0);
    for (const Block& block : blocks) {
      nearest_m = std::min(nearest_m, (p_W - p_W.cwiseMax(block.low_W).cwiseMin(block.high_W)).norm());
    }
    return nearest_m;
  }

 private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  /// Depth at which the ray meets something that gives depth, infinity if nothing or glass is met first.
  [[nodiscard]] double depthAlong(const Vec3& from_W, const Vec3& ray_W) const {
    double nearest_m = ray_W.z() < 0.0 ? -from_W.z() / ray_W.z() : kNothing;
    bool glass = false;
    for (const Block& block : blocks) {
      const double depth_m = depthOf(block, from_W, ray_W);
      if (depth_m >= nearest_m) continue;
      nearest_m = depth_m;
      glass = block.glass;
    }
    return glass ? kNothing : nearest_m;
  }

  [[nodiscard]] static double depthOf(const Block& block, const Vec3& from_W, const Vec3& ray_W) {
    double enters_m = 0.0;
    double leaves_m = kNothing;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (block.low_W[axis] - from_W[axis]) / ray_W[axis];
      const double b = (block.high_W[axis] - from_W[axis]) / ray_W[axis];
      enters_m = std::max(enters_m, std::min(a, b));
      leaves_m = std::min(leaves_m, std::max(a, b));
    }
    return enters_m < leaves_m ? enters_m : kNothing;
  }
};

}  // namespace nanomap::test
