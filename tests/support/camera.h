#pragma once

#include <memory>

#include "core/camera_model.h"

namespace nanomap::test {

/// The forward-looking mount: camera RDF in body FLU, at the body's origin.
inline Pose forwardMount() {
  Mat3 R_B_C;
  R_B_C << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Quat(R_B_C), Vec3::Zero()};
}

/// A small camera: 90 degrees wide, principal point in the middle, 0.2 .. 10 m, millimetres.
inline CameraParameters smallCamera(int width_px = 64, int height_px = 48) {
  CameraParameters camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = width_px / 2.0;
  camera.cx_px = (width_px - 1) / 2.0;
  camera.cy_px = (height_px - 1) / 2.0;
  camera.T_B_C = forwardMount();
  camera.min_range_m = 0.2;
  camera.max_range_m = 10.0;
  return camera;
}

inline std::shared_ptr<const CameraModel> model(CameraParameters camera) {
  return std::make_shared<const CameraModel>(std::move(camera));
}

}  // namespace nanomap::test
