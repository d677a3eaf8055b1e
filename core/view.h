#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/depth_tiles.h"
#include "core/image_index.h"
#include "core/nearest_point_index.h"
#include "core/tiled_image.h"

namespace nanomap {

/// Why a depth image cannot become a view.
enum class ImageFault : std::uint8_t {
  kEmpty,         ///< zero width or height
  kTruncated,     ///< pixel count is not width * height
  kSizeMismatch,  ///< the camera model has another size
  kUnitMismatch,  ///< the camera model has another depth unit
};
inline constexpr std::size_t kImageFaultCount = 4;

[[nodiscard]] std::string_view toString(ImageFault fault);

/// What keeps `image` from being a view of `camera`; empty if nothing does.
[[nodiscard]] std::optional<ImageFault> faultOf(const DepthImage& image, const CameraModel& camera);

/// One depth frame with its camera model and nearest-point index, and the bounds of its tiles. Shared as `ViewPtr`,
/// and then immutable: who builds a view finishes it first. Threads: any number of readers.
class View {
 public:
  /// Room for frames of `camera`; holds none before assign(). Allocates.
  View(std::shared_ptr<const CameraModel> camera, IndexKind kind);

  /// The view of `image`, searched through an index that the caller made of it.
  /// @pre faultOf(image, *camera) is empty
  View(const DepthImage& image, std::shared_ptr<const CameraModel> camera,
       std::unique_ptr<const NearestPointIndex> index);

  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// Makes this the view of `image`, in place of the frame before. @pre faultOf(image, camera()) is empty
  /// Allocates: no with IndexKind::kImage; FLANN's tree otherwise.
  void assign(const DepthImage& image);

  [[nodiscard]] Time stamp() const { return stamp_; }
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }
  [[nodiscard]] const CameraModel& camera() const { return *camera_; }
  [[nodiscard]] const NearestPointIndex& index() const { return image_index_ ? *image_index_ : *other_index_; }
  [[nodiscard]] const DepthTiles& tiles() const { return tiles_; }
  [[nodiscard]] const TiledImage& image() const { return image_; }

  /// Raw value at column `u`, row `v` inside the image.
  [[nodiscard]] std::uint16_t rawAt(int u, int v) const { return image_.at(u, v); }

 private:
  Time stamp_{};
  std::uint64_t sequence_ = 0;
  std::shared_ptr<const CameraModel> camera_;
  TiledImage image_;
  DepthTiles tiles_;
  std::optional<ImageIndex> image_index_;  ///< of image_
  std::unique_ptr<const NearestPointIndex> other_index_;
};

using ViewPtr = std::shared_ptr<const View>;

/// A checked image with its index built, or the reason why not. The image must have the camera's size and unit.
/// Allocates; ViewPool builds in storage that it has. Threads: a function of its arguments.
[[nodiscard]] std::variant<ViewPtr, ImageFault> buildView(const DepthImage& image,
                                                          std::shared_ptr<const CameraModel> camera,
                                                          IndexKind kind = IndexKind::kImage);

}  // namespace nanomap
