#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/depth_tiles.h"
#include "core/nearest_point_index.h"

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

/// One depth frame with its camera model and nearest-point index, and the bounds of its tiles. Immutable, shared by
/// every snapshot that holds it. Threads: any number of readers.
class View {
 public:
  /// @pre the image has the camera's size
  View(DepthImage image, std::shared_ptr<const CameraModel> camera, std::unique_ptr<const NearestPointIndex> index);

  [[nodiscard]] Time stamp() const { return image_.stamp; }
  [[nodiscard]] std::uint64_t sequence() const { return image_.sequence; }
  [[nodiscard]] const DepthImage& image() const { return image_; }
  [[nodiscard]] const CameraModel& camera() const { return *camera_; }
  [[nodiscard]] const NearestPointIndex& index() const { return *index_; }
  [[nodiscard]] const DepthTiles& tiles() const { return tiles_; }

  /// Raw value at column `u`, row `v` inside the image.
  [[nodiscard]] std::uint16_t rawAt(int u, int v) const {
    return image_
        .pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width_px) + static_cast<std::size_t>(u)];
  }

 private:
  DepthImage image_;
  std::shared_ptr<const CameraModel> camera_;
  std::unique_ptr<const NearestPointIndex> index_;
  DepthTiles tiles_;
};

using ViewPtr = std::shared_ptr<const View>;

/// Stage T2: a checked image with its index built, or the reason why not. The image must have the camera's size and
/// unit. Allocates. Threads: a function of its arguments.
[[nodiscard]] std::variant<ViewPtr, ImageFault> buildView(DepthImage image, std::shared_ptr<const CameraModel> camera);

}  // namespace nanomap
