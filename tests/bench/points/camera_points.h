#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"

namespace nanomap::bench {

/// A point in C, in front of what `image` shows or where it shows nothing: a random pixel, a random distance up to 15 m
/// (three quarters of the paper's range) or the camera's range, whichever is less.
/// @throws std::runtime_error if none is found in thousands of tries: the image shows a surface at the lens
[[nodiscard]] Vec3f drawFreePoint(const DepthImage& image, const CameraModel& camera, std::mt19937& random);

/// `count` such points: uniform in the frustum.
[[nodiscard]] std::vector<Vec3f> uniformPoints(const DepthImage& image, const CameraModel& camera, std::size_t count);

/// `count` points in C as a planner asks for: 20 samples along each of the library's primitives, flown level from drawn
/// velocities, if they are in the frustum and in front of what `image` shows.
/// @throws std::runtime_error as above
[[nodiscard]] std::vector<Vec3f> primitivePoints(const DepthImage& image, const CameraModel& camera, std::size_t count);

}  // namespace nanomap::bench
