#include "firmware_app/pipeline/view_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::smallCamera;

DepthInput frame(const std::string& camera_name = "") {
  return {camera_name, test::flatImage(CameraModel(smallCamera()), 5000)};
}

TEST(ViewBuilder, WithoutACameraNothingIsBuilt) {
  ViewBuilder builder{std::nullopt};
  EXPECT_EQ(std::get<CameraFault>(builder.build(frame())), CameraFault::kNoCamera);
}

TEST(ViewBuilder, ConfiguredCameraIsTheOnlyOne) {
  ViewBuilder builder(smallCamera());
  EXPECT_TRUE(std::holds_alternative<ViewPtr>(builder.build(frame("any"))));
  EXPECT_EQ(builder.setCamera({"front", smallCamera(32, 24)}), CameraVerdict::kOverridden);
  EXPECT_EQ(builder.camera()->width(), 64);
}

TEST(ViewBuilder, ConfiguredCameraThatCannotBeIsRefused) {
  EXPECT_THROW(ViewBuilder{CameraParameters{}}, std::invalid_argument);
}

TEST(ViewBuilder, RepeatedCameraKeepsTheModel) {
  ViewBuilder builder{std::nullopt};
  EXPECT_EQ(builder.setCamera({"front", smallCamera()}), CameraVerdict::kFirst);
  const auto model = builder.camera();
  EXPECT_EQ(builder.setCamera({"front", smallCamera()}), CameraVerdict::kUnchanged);
  EXPECT_EQ(builder.camera(), model);
}

TEST(ViewBuilder, ChangedCameraIsUsedFromThenOn) {
  ViewBuilder builder{std::nullopt};
  EXPECT_EQ(builder.setCamera({"front", smallCamera()}), CameraVerdict::kFirst);
  CameraParameters moved = smallCamera();
  moved.T_B_C.translation_m.z() = 0.1;
  EXPECT_EQ(builder.setCamera({"front", moved}), CameraVerdict::kChanged);
  EXPECT_EQ(builder.camera()->parameters(), moved);
}

TEST(ViewBuilder, OtherCamerasAreLeftOut) {
  ViewBuilder builder{std::nullopt};
  EXPECT_EQ(builder.setCamera({"front", smallCamera()}), CameraVerdict::kFirst);
  EXPECT_EQ(builder.setCamera({"rear", smallCamera()}), CameraVerdict::kOtherCamera);
  EXPECT_EQ(std::get<CameraFault>(builder.build(frame("rear"))), CameraFault::kOtherCamera);
  EXPECT_TRUE(std::holds_alternative<ViewPtr>(builder.build(frame("front"))));
  EXPECT_TRUE(std::holds_alternative<ViewPtr>(builder.build(frame(""))));
}

TEST(ViewBuilder, InvalidCameraSaysWhyAndKeepsTheOneBefore) {
  ViewBuilder builder{std::nullopt};
  EXPECT_EQ(builder.setCamera({"front", smallCamera()}), CameraVerdict::kFirst);
  CameraParameters broken = smallCamera();
  broken.fx_px = 0.0;
  EXPECT_EQ(builder.setCamera({"front", broken}), CameraVerdict::kInvalid);
  EXPECT_THAT(builder.lastCameraFault(), ::testing::HasSubstr("fx"));
  EXPECT_EQ(builder.camera()->parameters(), smallCamera());
}

TEST(ViewBuilder, ImageThatDoesNotFitIsAFault) {
  ViewBuilder builder(smallCamera());
  DepthInput input = frame();
  input.image.pixels.pop_back();
  EXPECT_EQ(std::get<ImageFault>(builder.build(input)), ImageFault::kTruncated);
}

}  // namespace
}  // namespace nanomap
