#include "tools/import/camera_preset.h"

#include <algorithm>
#include <array>

#include "firmware_app/configuration/camera_mount.h"
#include "tools/import/numbered_layout.h"
#include "tools/import/tum_layout.h"

namespace nanomap {
namespace {

/// A first-generation Kinect returns nothing nearer, and its depth steps pass 10 cm beyond.
constexpr double kKinectMinRange_m = 0.4;
constexpr double kKinectMaxRange_m = 6.0;

CameraParameters kinect(double fx_px, double fy_px, double cx_px, double cy_px, Distortion distortion, double unit_m) {
  CameraParameters camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = fx_px;
  camera.fy_px = fy_px;
  camera.cx_px = cx_px;
  camera.cy_px = cy_px;
  camera.distortion = distortion;
  camera.T_B_C.rotation = rotationOfMount({});
  camera.depth_unit_m = unit_m;
  camera.min_range_m = kKinectMinRange_m;
  camera.max_range_m = kKinectMaxRange_m;
  return camera;
}

}  // namespace

std::span<const CameraPreset> cameraPresets() {
  static const std::array<CameraPreset, 4> presets{{
      {"kinect-office", kinect(585.0, 585.0, 320.0, 240.0, {}, kNumberedDepthUnit_m)},
      {"tum-freiburg1",
       kinect(517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}, kTumDepthUnit_m)},
      {"tum-freiburg2",
       kinect(520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}, kTumDepthUnit_m)},
      {"tum-freiburg3", kinect(535.4, 539.2, 320.1, 247.6, {}, kTumDepthUnit_m)},
  }};
  return presets;
}

std::optional<CameraParameters> findCameraPreset(std::string_view name) {
  const auto found = std::ranges::find(cameraPresets(), name, &CameraPreset::name);
  if (found == cameraPresets().end()) return std::nullopt;
  return found->camera;
}

}  // namespace nanomap
