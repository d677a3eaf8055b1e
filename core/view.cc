#include "core/view.h"

#include <cmath>
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

std::optional<ImageFault> faultOf(const DepthImage& image, const CameraModel& camera) {
  /// Units are written as decimals and pass through single precision in places.
  constexpr double kUnitTolerance = 1e-6;
  if (image.width_px <= 0 || image.height_px <= 0) return ImageFault::kEmpty;
  if (image.pixels.size() != static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px)) {
    return ImageFault::kTruncated;
  }
  if (image.width_px != camera.width() || image.height_px != camera.height()) return ImageFault::kSizeMismatch;
  const double unit_m = camera.parameters().depth_unit_m;
  if (!(std::abs(image.depth_unit_m - unit_m) <= kUnitTolerance * unit_m)) return ImageFault::kUnitMismatch;
  return std::nullopt;
}

View::View(std::shared_ptr<const CameraModel> camera, IndexKind kind)
    : camera_(std::move(camera)), image_({camera_->width(), camera_->height()}), tiles_(*camera_) {
  if (kind == IndexKind::kImage) image_index_.emplace(camera_, image_);
}

View::View(const DepthImage& image, std::shared_ptr<const CameraModel> camera,
           std::unique_ptr<const NearestPointIndex> index)
    : stamp_(image.stamp),
      sequence_(image.sequence),
      camera_(std::move(camera)),
      image_({camera_->width(), camera_->height()}),
      tiles_(*camera_),
      other_index_(std::move(index)) {
  image_.assign(image.pixels);
  tiles_.assign(image, *camera_);
}

void View::assign(const DepthImage& image) {
  stamp_ = image.stamp;
  sequence_ = image.sequence;
  if (image_index_) {
    image_index_->build(image.pixels);
  } else {
    image_.assign(image.pixels);
    other_index_ = buildFlannIndex(image, *camera_);
  }
  tiles_.assign(image, *camera_);
}

std::variant<ViewPtr, ImageFault> buildView(const DepthImage& image, std::shared_ptr<const CameraModel> camera,
                                            IndexKind kind) {
  if (const auto fault = faultOf(image, *camera)) return *fault;
  const auto view = std::make_shared<View>(std::move(camera), kind);
  view->assign(image);
  return view;
}

}  // namespace nanomap
