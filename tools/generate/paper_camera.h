#pragma once

#include "core/camera_model.h"

namespace nanomap::generate {

/// The depth camera of the paper's simulated flights (section V): 90 x 60 degrees, trusted up to 20 m, looking straight
/// ahead from 0.1 m before the body's origin.
[[nodiscard]] CameraParameters paperCamera(int width_px, int height_px);

}  // namespace nanomap::generate
