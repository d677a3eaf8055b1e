#include "core/view.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/flann_index.h"

namespace nanomap {

std::string_view toString(ImageFault fault) {
  switch (fault) {
    case ImageFault::kEmpty:
      return "zero-sized image";
    case ImageFault::kTruncated:
      return "truncated image";
    case ImageFault::kSizeMismatch:
      return "image size unlike the camera model's";
    case ImageFault::kUnitMismatch:
      return "depth unit unlike the camera model's";
  }
  return "?";
}

View::View(DepthImage image, std::shared_ptr<const CameraModel> camera, std::unique_ptr<const NearestPointIndex> index)
    : image_(std::move(image)), camera_(std::move(camera)), index_(std::move(index)), tiles_(image_, *camera_) {}

namespace {

/// Units are written as decimals and pass through single precision in places.
constexpr double kUnitTolerance = 1e-6;

std::optional<ImageFault> faultOf(const DepthImage& image, const CameraModel& camera) {
  if (image.width_px <= 0 || image.height_px <= 0) return ImageFault::kEmpty;
  if (image.pixels.size() != static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px)) {
    return ImageFault::kTruncated;
  }
  if (image.width_px != camera.width() || image.height_px != camera.height()) return ImageFault::kSizeMismatch;
  const double unit_m = camera.parameters().depth_unit_m;
  if (!(std::abs(image.depth_unit_m - unit_m) <= kUnitTolerance * unit_m)) return ImageFault::kUnitMismatch;
  return std::nullopt;
}

}  // namespace

std::variant<ViewPtr, ImageFault> buildView(DepthImage image, std::shared_ptr<const CameraModel> camera) {
  if (const auto fault = faultOf(image, *camera)) return *fault;
  auto index = buildFlannIndex(image, *camera);
  return std::make_shared<const View>(std::move(image), std::move(camera), std::move(index));
}

}  // namespace nanomap
