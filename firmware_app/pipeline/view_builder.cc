#include "firmware_app/pipeline/view_builder.h"

#include <stdexcept>
#include <utility>

namespace nanomap {

std::string_view toString(CameraVerdict verdict) {
  switch (verdict) {
    case CameraVerdict::kFirst:
      return "first";
    case CameraVerdict::kUnchanged:
      return "unchanged";
    case CameraVerdict::kChanged:
      return "changed";
    case CameraVerdict::kOverridden:
      return "overridden by the configuration";
    case CameraVerdict::kOtherCamera:
      return "of another camera";
    case CameraVerdict::kInvalid:
      return "invalid";
  }
  return "?";
}

std::string_view toString(CameraFault fault) {
  switch (fault) {
    case CameraFault::kNoCamera:
      return "no camera model yet";
    case CameraFault::kOtherCamera:
      return "of another camera";
  }
  return "?";
}

ViewBuilder::ViewBuilder(const std::optional<CameraParameters>& configured, IndexKind index, std::size_t reserved_views)
    : index_(index), reserved_views_(reserved_views), configured_(configured.has_value()) {
  if (configured) use(*configured);
}

void ViewBuilder::use(const CameraParameters& camera) {
  camera_ = std::make_shared<const CameraModel>(camera);
  pool_.emplace(camera_, index_, reserved_views_);
}

CameraVerdict ViewBuilder::setCamera(const CameraInput& input) {
  if (configured_) return CameraVerdict::kOverridden;
  if (camera_ && input.name != name_) return CameraVerdict::kOtherCamera;
  if (camera_ && input.parameters == as_received_) return CameraVerdict::kUnchanged;
  try {
    const CameraVerdict verdict = camera_ ? CameraVerdict::kChanged : CameraVerdict::kFirst;
    use(input.parameters);
    as_received_ = input.parameters;
    name_ = input.name;
    return verdict;
  } catch (const std::invalid_argument& error) {
    last_camera_fault_ = error.what();
    return CameraVerdict::kInvalid;
  }
}

std::variant<ViewPtr, ImageFault, CameraFault> ViewBuilder::build(const DepthInput& input) {
  if (!camera_) return CameraFault::kNoCamera;
  const bool both_named = !input.camera.empty() && !name_.empty();
  if (both_named && input.camera != name_) return CameraFault::kOtherCamera;
  auto built = pool_->build(input.image);
  if (const auto* fault = std::get_if<ImageFault>(&built)) return *fault;
  return std::get<ViewPtr>(std::move(built));
}

}  // namespace nanomap
