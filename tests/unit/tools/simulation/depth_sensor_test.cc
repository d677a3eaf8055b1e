#include "tools/simulation/depth_sensor.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nanomap::simulation {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::uint64_t kSeed = 11;
constexpr float kNothing = std::numeric_limits<float>::infinity();

CameraModel cameraOf(int width_px, int height_px) {
  CameraParameters camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = 160.0;
  camera.fy_px = 160.0;
  camera.cx_px = width_px / 2.0;
  camera.cy_px = height_px / 2.0;
  camera.max_range_m = 20.0;
  return CameraModel(camera);
}

DepthImage measureEvenly(float depth_m, const DepthSensorParameters& parameters, const CameraModel& camera) {
  return DepthSensor(camera, parameters, kSeed).measure(std::vector<float>(camera.pixelCount(), depth_m), Time{}, 0);
}

struct Moments {
  double mean_m = 0.0;
  double std_m = 0.0;
};

Moments momentsOf(const DepthImage& image) {
  double sum_m = 0.0;
  double sum_m2 = 0.0;
  for (const std::uint16_t raw : image.pixels) {
    const double depth_m = raw * image.depth_unit_m;
    sum_m += depth_m;
    sum_m2 += depth_m * depth_m;
  }
  const double count = static_cast<double>(image.pixels.size());
  const double mean_m = sum_m / count;
  return {mean_m, std::sqrt(sum_m2 / count - mean_m * mean_m)};
}

TEST(DepthSensor, IdealRoundsToTheDepthUnit) {
  const CameraModel camera = cameraOf(4, 1);
  const DepthSensor sensor(camera, DepthSensorParameters::ideal(), kSeed);
  const DepthImage image = sensor.measure(std::vector<float>{1.0F, 2.00049F, 2.00051F, 19.9999F}, Time{Duration(7)}, 5);
  EXPECT_THAT(image.pixels, testing::ElementsAre(1000, 2000, 2001, 20000));
  EXPECT_EQ(image.stamp, Time{Duration(7)});
  EXPECT_EQ(image.sequence, 5U);
  EXPECT_EQ(image.width_px, 4);
  EXPECT_EQ(image.height_px, 1);
  EXPECT_EQ(image.depth_unit_m, 0.001);
}

TEST(DepthSensor, OutsideItsRangeNothingReturns) {
  const CameraModel camera = cameraOf(6, 1);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.min_range_m = 0.5;
  parameters.max_range_m = 10.0;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const DepthImage image = DepthSensor(camera, parameters, kSeed)
                               .measure(std::vector<float>{0.49F, 0.5F, 10.0F, 10.01F, kNothing, nan}, Time{}, 0);
  EXPECT_THAT(image.pixels, testing::ElementsAre(0, 500, 10000, 0, 0, 0));
}

TEST(DepthSensor, DepthBeyondTheLargestCountIsNoReturn) {
  const CameraModel camera = cameraOf(1, 1);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.max_range_m = 100.0;
  EXPECT_THAT(measureEvenly(65.534F, parameters, camera).pixels, Each(65534));
  EXPECT_THAT(measureEvenly(65.6F, parameters, camera).pixels, Each(0));
}

TEST(DepthSensor, NoiseGrowsAsConfigured) {
  const CameraModel camera = cameraOf(320, 240);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.noise_constant_m = 0.01;
  parameters.noise_quadratic_per_m = 0.002;
  for (const double depth_m : {2.0, 8.0, 16.0}) {
    const Moments moments = momentsOf(measureEvenly(static_cast<float>(depth_m), parameters, camera));
    const double std_m = 0.01 + 0.002 * depth_m * depth_m;
    // Five standard errors of the mean, and of the standard deviation, of so many pixels.
    const double count = static_cast<double>(camera.pixelCount());
    EXPECT_NEAR(moments.mean_m, depth_m, 5.0 * std_m / std::sqrt(count)) << "seed " << kSeed;
    EXPECT_NEAR(moments.std_m, std_m, 5.0 * std_m / std::sqrt(2.0 * count)) << "seed " << kSeed;
  }
}

TEST(DepthSensor, DropoutsHaveTheConfiguredShare) {
  const CameraModel camera = cameraOf(320, 240);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.dropout_probability = 0.03;
  const DepthImage image = measureEvenly(4.0F, parameters, camera);
  const double count = static_cast<double>(camera.pixelCount());
  const double share = static_cast<double>(std::count(image.pixels.begin(), image.pixels.end(), 0)) / count;
  EXPECT_NEAR(share, 0.03, 5.0 * std::sqrt(0.03 * 0.97 / count)) << "seed " << kSeed;
}

TEST(DepthSensor, PatchesCoverTheConfiguredShareAndHangTogether) {
  const CameraModel camera = cameraOf(320, 240);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.patch_share = 0.3;
  const DepthImage image = measureEvenly(4.0F, parameters, camera);
  const double count = static_cast<double>(camera.pixelCount());
  const auto lost = static_cast<double>(std::count(image.pixels.begin(), image.pixels.end(), 0));
  constexpr double kOfOnePatch = 0.06 * 0.06 * 3.15;  // at most
  EXPECT_GE(lost / count, 0.3);
  EXPECT_LE(lost / count, 0.3 + kOfOnePatch);
  double edges = 0.0;  // along rows, from lost to seen or back
  for (std::size_t i = 1; i < image.pixels.size(); ++i) {
    edges += static_cast<double>((image.pixels[i] == 0) != (image.pixels[i - 1] == 0));
  }
  EXPECT_LT(edges / lost, 0.2) << "by itself each pixel has 1.4";
}

TEST(DepthSensor, EverythingDroppedLeavesNoReturn) {
  const CameraModel camera = cameraOf(8, 8);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.dropout_probability = 1.0;
  EXPECT_THAT(measureEvenly(4.0F, parameters, camera).pixels, Each(0));
}

TEST(DepthSensor, StereoReportsWholeStepsOfDisparity) {
  const CameraModel camera = cameraOf(1, 1);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.stereo_baseline_m = 0.05;  // 8 px m
  parameters.disparity_step_px = 0.125;
  // At 10 m the disparity is 0.8 px, between steps 6 (10.667 m) and 7 (9.143 m); 0.8 / 0.125 = 6.4.
  EXPECT_THAT(measureEvenly(10.0F, parameters, camera).pixels, Each(10667));
  // A disparity below half a step is infinitely far.
  parameters.max_range_m = 200.0;
  EXPECT_THAT(measureEvenly(150.0F, parameters, camera).pixels, Each(0));
}

TEST(DepthSensor, StereoLosesWhatTheRightImagerCannotSee) {
  const CameraModel camera = cameraOf(40, 1);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.stereo_baseline_m = 0.1;  // 16 px m: 8 px at 2 m, 2 px at 8 m
  parameters.disparity_step_px = 0.0;
  std::vector<float> depth_m(40, 8.0F);
  std::fill(depth_m.begin() + 20, depth_m.begin() + 30, 2.0F);
  const DepthImage image = DepthSensor(camera, parameters, kSeed).measure(depth_m, Time{}, 0);
  for (std::size_t u = 0; u < 40; ++u) {
    const bool shadowed = u >= 14 && u < 20;  // six pixels, left of what is near
    EXPECT_EQ(image.pixels[u] == 0, shadowed) << "column " << u;
  }
}

TEST(DepthSensor, StereoSeesAnEvenSlopeWhole) {
  const CameraModel camera = cameraOf(40, 1);
  DepthSensorParameters parameters = DepthSensorParameters::ideal();
  parameters.stereo_baseline_m = 0.1;
  parameters.disparity_step_px = 0.0;
  std::vector<float> depth_m;
  for (int u = 0; u < 40; ++u) depth_m.push_back(5.0F + 0.05F * static_cast<float>(u));
  EXPECT_THAT(DepthSensor(camera, parameters, kSeed).measure(depth_m, Time{}, 0).pixels, Each(testing::Gt(0)));
}

TEST(DepthSensor, FrameDependsOnSeedAndSequenceOnly) {
  const CameraModel camera = cameraOf(32, 24);
  const std::vector<float> depth_m(camera.pixelCount(), 5.0F);
  const DepthSensor sensor(camera, {}, 1);
  const auto first = sensor.measure(depth_m, Time{}, 3).pixels;
  EXPECT_NE(sensor.measure(depth_m, Time{}, 4).pixels, first);
  EXPECT_EQ(sensor.measure(depth_m, Time{}, 3).pixels, first);
  EXPECT_NE(DepthSensor(camera, {}, 2).measure(depth_m, Time{}, 3).pixels, first);
}

TEST(DepthSensor, WrongParametersAreNamed) {
  const CameraModel camera = cameraOf(2, 2);
  DepthSensorParameters parameters;
  parameters.dropout_probability = 1.5;
  EXPECT_THAT([&] { DepthSensor(camera, parameters, kSeed); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("dropout_probability is 1.5")));
  parameters = {};
  parameters.patch_share = -0.1;
  EXPECT_THAT([&] { DepthSensor(camera, parameters, kSeed); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("patch_share is -0.1")));
  parameters = {};
  parameters.max_range_m = 0.1;
  EXPECT_THAT([&] { DepthSensor(camera, parameters, kSeed); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("max_range_m")));
  parameters = {};
  parameters.noise_constant_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { DepthSensor(camera, parameters, kSeed); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("noise_constant_m")));
}

TEST(DepthSensor, DepthOfAnotherSizeIsRefused) {
  const CameraModel camera = cameraOf(2, 2);
  EXPECT_THAT([&] { (void)DepthSensor(camera, {}, kSeed).measure(std::vector<float>(3, 1.0F), Time{}, 0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("3 depths given for 4 pixels")));
}

}  // namespace
}  // namespace nanomap::simulation
