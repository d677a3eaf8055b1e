#pragma once

#include <cstdint>
#include <random>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/view.h"
#include "tests/support/camera.h"

namespace nanomap::test {

/// An image that reads `raw` everywhere.
inline DepthImage flatImage(const CameraModel& camera, std::uint16_t raw, Time stamp = {}) {
  DepthImage image;
  image.stamp = stamp;
  image.width_px = camera.width();
  image.height_px = camera.height();
  image.depth_unit_m = camera.parameters().depth_unit_m;
  image.pixels.assign(camera.pixelCount(), raw);
  return image;
}

/// Paints columns u0..u1 and rows v0..v1, ends included.
inline void paint(DepthImage& image, int u0, int u1, int v0, int v1, std::uint16_t raw) {
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) image.pixels[static_cast<std::size_t>(v * image.width_px + u)] = raw;
  }
}

/// Depths between `low` and `high` counts, a share of them without a return.
inline DepthImage randomImage(const CameraModel& camera, std::mt19937& random, std::uint16_t low, std::uint16_t high,
                              double no_return_share) {
  DepthImage image = flatImage(camera, 0);
  std::uniform_int_distribution<int> raw(low, high);
  std::bernoulli_distribution none(no_return_share);
  for (std::uint16_t& pixel : image.pixels)
    pixel = none(random) ? std::uint16_t{0} : static_cast<std::uint16_t>(raw(random));
  return image;
}

/// @pre the image fits the camera
inline ViewPtr viewOf(const DepthImage& image, std::shared_ptr<const CameraModel> camera,
                      IndexKind kind = IndexKind::kImage) {
  return std::get<ViewPtr>(buildView(image, std::move(camera), kind));
}

}  // namespace nanomap::test
