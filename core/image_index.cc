#include "core/image_index.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/box_groups_build.h"
#include "core/box_groups_search.h"
#include "core/search_radius.h"

namespace nanomap {

ImageIndex::ImageIndex(std::shared_ptr<const CameraModel> camera, TiledImage& image)
    : camera_(std::move(camera)), image_(image), boxes_(image.grid()) {
  assert(image.grid() == camera_->rayTiles().grid());
}

void ImageIndex::build(std::span<const std::uint16_t> pixels) {
  assert(pixels.size() == camera_->pixelCount());
  buildBoxGroups(pixels, camera_->rayTiles(), camera_->inRange(), camera_->depthUnit_m(), image_, boxes_);
}

std::size_t ImageIndex::nearest(const Vec3f& p_C, std::span<Neighbour> out, float max_distance_m) const {
  assert(!out.empty() && out.size() <= kMaxNeighbours);
  const auto limit_sq_m2 = greatestSquareWithin(max_distance_m);
  if (!limit_sq_m2 || !p_C.allFinite()) return 0;
  const IndexedImage indexed{boxes_, image_, camera_->rayTiles(), camera_->inRange(), camera_->depthUnit_m()};
  std::array<FoundPixel, kMaxNeighbours> found;
  const std::size_t count = findNearest(indexed, p_C, *limit_sq_m2, std::span(found).first(out.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t tile = found[i].pixel / TileGrid::kTilePixels;
    const std::size_t place = found[i].pixel % TileGrid::kTilePixels;
    const RayTiles& rays = camera_->rayTiles();
    const float z_m = camera_->depth(image_.tiles()[tile].raw[place]);
    out[i] = {{rays.x(tile).tangents[place] * z_m, rays.y(tile).tangents[place] * z_m, z_m},
              std::sqrt(found[i].distance_sq_m2)};
  }
  return count;
}

std::size_t ImageIndex::size() const {
  std::size_t count = 0;
  for (int v = 0; v < camera_->height(); ++v) {
    for (int u = 0; u < camera_->width(); ++u)
      count += static_cast<std::size_t>(camera_->inRange().contains(image_.at(u, v)));
  }
  return count;
}

}  // namespace nanomap
