#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/camera_model.h"

namespace nanomap {

/// A published calibration, for images of the size that it was made at; the camera looks straight ahead from the
/// body's origin.
struct CameraPreset {
  std::string_view name;
  CameraParameters camera;
};

/// Every preset: the Kinect of 7-Scenes, and the three of the TUM RGB-D benchmark (its "file formats" page; depth there
/// is registered to the colour camera, so that the colour camera's calibration holds).
[[nodiscard]] std::span<const CameraPreset> cameraPresets();

/// @return empty if there is none of that name
[[nodiscard]] std::optional<CameraParameters> findCameraPreset(std::string_view name);

}  // namespace nanomap
