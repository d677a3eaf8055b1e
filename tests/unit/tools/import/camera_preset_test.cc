#include "tools/import/camera_preset.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

TEST(CameraPreset, EveryOneIsAValidCamera) {
  for (const CameraPreset& preset : cameraPresets()) {
    EXPECT_NO_THROW(CameraModel{preset.camera}) << preset.name;
    ASSERT_TRUE(findCameraPreset(preset.name).has_value());
    EXPECT_EQ(findCameraPreset(preset.name)->fx_px, preset.camera.fx_px);
  }
}

TEST(CameraPreset, LooksForward) {
  const Pose& T_B_C = cameraPresets().front().camera.T_B_C;
  EXPECT_EQ(T_B_C * Vec3(1.0, 2.0, 3.0), Vec3(3.0, -1.0, -2.0));
}

TEST(CameraPreset, IsEmptyForUnknownNames) {
  EXPECT_FALSE(findCameraPreset("").has_value());
  EXPECT_FALSE(findCameraPreset("tum-freiburg4").has_value());
}

}  // namespace
}  // namespace nanomap
