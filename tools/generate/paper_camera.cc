#include "tools/generate/paper_camera.h"

#include <cmath>
#include <numbers>

#include "firmware_app/configuration/camera_mount.h"

namespace nanomap::generate {

CameraParameters paperCamera(int width_px, int height_px) {
  constexpr double kHalfWidth_rad = std::numbers::pi / 4.0;
  constexpr double kHalfHeight_rad = std::numbers::pi / 6.0;
  CameraParameters camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = width_px / 2.0 / std::tan(kHalfWidth_rad);
  camera.fy_px = height_px / 2.0 / std::tan(kHalfHeight_rad);
  camera.cx_px = (width_px - 1) / 2.0;
  camera.cy_px = (height_px - 1) / 2.0;
  camera.T_B_C = {rotationOfMount({}), Vec3(0.1, 0.0, 0.0)};
  camera.min_range_m = 0.3;
  camera.max_range_m = 20.0;
  return camera;
}

}  // namespace nanomap::generate
