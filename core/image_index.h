#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/box_groups.h"
#include "core/camera_model.h"
#include "core/nearest_point_index.h"
#include "core/tiled_image.h"

namespace nanomap {

/// Nearest-point index that knows its points to be an image: neighbours in it are neighbours in space. Boxes around
/// the points of each tile, and around groups of boxes, bound the search; points are computed from the pixels when they
/// are looked at, so that the index adds half as much memory again to the image.
/// Answers are those of a search through all points, to the last bit, and the same on every instruction set; of points
/// at equal distance those in the earlier tile come first (core/tile_grid.h).
class ImageIndex final : public NearestPointIndex {
 public:
  /// Empty at first. Allocates; nothing else does.
  /// @param image  what build() cuts the image into and nearest() reads; of the camera's size. Must outlive the index.
  ImageIndex(std::shared_ptr<const CameraModel> camera, TiledImage& image);

  /// Cuts `pixels` into tiles and indexes the returns in the camera's trusted range, in place of what there was before.
  /// @pre row-major, of the camera's size. @pre nobody reads meanwhile
  void build(std::span<const std::uint16_t> pixels);

  [[nodiscard]] std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out,
                                    float max_distance_m = kAnyDistance) const override;

  /// Counts, pixel by pixel.
  [[nodiscard]] std::size_t size() const override;

 private:
  std::shared_ptr<const CameraModel> camera_;
  TiledImage& image_;
  BoxGroups boxes_;
};

}  // namespace nanomap
