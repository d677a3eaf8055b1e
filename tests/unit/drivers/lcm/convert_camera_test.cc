#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/depth_codec.h"

namespace nanomap {
namespace {

CameraParameters camera() {
  CameraParameters parameters;
  parameters.width_px = 320;
  parameters.height_px = 240;
  parameters.fx_px = 200.0;
  parameters.fy_px = 201.0;
  parameters.cx_px = 160.0;
  parameters.cy_px = 121.0;
  parameters.distortion = {.k1 = 0.1, .k2 = 0.2, .p1 = 0.3, .p2 = 0.4, .k3 = 0.5};
  parameters.T_B_C = {Quat(0.5, -0.5, 0.5, -0.5), {0.1, 0.2, 0.3}};
  parameters.depth_unit_m = 0.0001;
  parameters.min_range_m = 0.4;
  parameters.max_range_m = 12.0;
  parameters.no_return_values = {0, 1, 65535};
  return parameters;
}

TEST(ToCameraParameters, WhatWasMadeOfACameraGivesItBack) {
  const CameraParameters sent = camera();
  const camera_model_t message = toMessage(sent, "front", Time(std::chrono::seconds(1)));
  EXPECT_EQ(message.name, "front");
  EXPECT_EQ(message.utime, 1'000'000);
  const auto back = std::get<CameraParameters>(toCameraParameters(message));
  EXPECT_EQ(back.width_px, sent.width_px);
  EXPECT_EQ(back.height_px, sent.height_px);
  EXPECT_EQ(back.fx_px, sent.fx_px);
  EXPECT_EQ(back.fy_px, sent.fy_px);
  EXPECT_EQ(back.cx_px, sent.cx_px);
  EXPECT_EQ(back.cy_px, sent.cy_px);
  EXPECT_EQ(back.distortion.k1, sent.distortion.k1);
  EXPECT_EQ(back.distortion.k2, sent.distortion.k2);
  EXPECT_EQ(back.distortion.p1, sent.distortion.p1);
  EXPECT_EQ(back.distortion.p2, sent.distortion.p2);
  EXPECT_EQ(back.distortion.k3, sent.distortion.k3);
  EXPECT_EQ(back.T_B_C.rotation.coeffs(), sent.T_B_C.rotation.coeffs());
  EXPECT_EQ(back.T_B_C.translation_m, sent.T_B_C.translation_m);
  EXPECT_EQ(back.depth_unit_m, sent.depth_unit_m);
  EXPECT_EQ(back.min_range_m, sent.min_range_m);
  EXPECT_EQ(back.max_range_m, sent.max_range_m);
  EXPECT_EQ(back.no_return_values, sent.no_return_values);
}

TEST(ToCameraParameters, NegativeSizeIsNamed) {
  camera_model_t message = toMessage(camera(), "", Time{});
  message.height = -240;
  EXPECT_EQ(std::get<ConvertFault>(toCameraParameters(message)), ConvertFault::kBadSize);
}

TEST(ToCameraParameters, SizeBeyondEveryImageIsNamed) {
  camera_model_t message = toMessage(camera(), "", Time{});
  message.width = std::numeric_limits<std::int32_t>::max();
  message.height = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(std::get<ConvertFault>(toCameraParameters(message)), ConvertFault::kBadSize);
  message.width = static_cast<std::int32_t>(kMaxImagePixels);
  message.height = 1;
  EXPECT_TRUE(std::holds_alternative<CameraParameters>(toCameraParameters(message)));
  message.height = 2;
  EXPECT_EQ(std::get<ConvertFault>(toCameraParameters(message)), ConvertFault::kBadSize);
}

TEST(ToCameraParameters, NoReturnValueBeyond16BitsIsNamed) {
  for (const std::int32_t value : {-1, 65536}) {
    camera_model_t message = toMessage(camera(), "", Time{});
    message.no_return_values.back() = value;
    EXPECT_EQ(std::get<ConvertFault>(toCameraParameters(message)), ConvertFault::kBadNoReturnValue) << value;
  }
}

TEST(ToCameraParameters, EmptyListMeansNoDefaults) {
  camera_model_t message = toMessage(camera(), "", Time{});
  message.no_return_values.clear();
  EXPECT_TRUE(std::get<CameraParameters>(toCameraParameters(message)).no_return_values.empty());
}

}  // namespace
}  // namespace nanomap
