#include "core/camera_model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/support/camera.h"

namespace nanomap {
namespace {

using test::smallCamera;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The Brown-Conrady polynomial as OpenCV's manual prints it, written apart from core's.
Eigen::Vector2d brownConrady(const Distortion& d, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1.0 + d.k1 * r2 + d.k2 * std::pow(r2, 2) + d.k3 * std::pow(r2, 3);
  return {x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
          y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y};
}

struct BadParameter {
  const char* name;
  void (*spoil)(CameraParameters&);
};

class CameraModelRejects : public testing::TestWithParam<BadParameter> {};

TEST_P(CameraModelRejects, NamesTheParameter) {
  CameraParameters camera = smallCamera();
  GetParam().spoil(camera);
  try {
    const CameraModel model(camera);
    FAIL() << "accepted a bad " << GetParam().name;
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().name));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, CameraModelRejects,
    testing::Values(BadParameter{"width", [](CameraParameters& c) { c.width_px = 0; }},
                    BadParameter{"height", [](CameraParameters& c) { c.height_px = -1; }},
                    BadParameter{"fx", [](CameraParameters& c) { c.fx_px = 0.0; }},
                    BadParameter{"fy", [](CameraParameters& c) { c.fy_px = kNaN; }},
                    BadParameter{"cx", [](CameraParameters& c) { c.cx_px = kNaN; }},
                    BadParameter{"depth_unit_m", [](CameraParameters& c) { c.depth_unit_m = 0.0; }},
                    BadParameter{"min_range_m", [](CameraParameters& c) { c.min_range_m = -0.1; }},
                    BadParameter{"max_range_m", [](CameraParameters& c) { c.max_range_m = c.min_range_m; }},
                    BadParameter{"extrinsic", [](CameraParameters& c) { c.T_B_C.rotation.coeffs() *= 2.0; }},
                    BadParameter{"distortion", [](CameraParameters& c) { c.distortion.k1 = -2.0; }}));

TEST(CameraModel, DeprojectedPixelsProjectToThemselves) {
  const CameraModel camera(smallCamera());
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u) {
      const Vec3 p_C = camera.deproject(static_cast<std::size_t>(v * camera.width() + u), 2000).cast<double>();
      EXPECT_FLOAT_EQ(static_cast<float>(p_C.z()), 2.0F);
      const auto pixel = camera.pixelAt(p_C.x() / p_C.z(), p_C.y() / p_C.z());
      ASSERT_TRUE(pixel);
      EXPECT_EQ(pixel->u, u);
      EXPECT_EQ(pixel->v, v);
    }
  }
}

TEST(CameraModel, PixelsReachHalfAPixelAroundTheirCentre) {
  const CameraParameters c = smallCamera();
  const CameraModel camera(c);
  const auto tangent = [&](double u) { return (u - c.cx_px) / c.fx_px; };
  EXPECT_EQ(camera.pixelAt(tangent(-0.49), 0.0)->u, 0);
  EXPECT_EQ(camera.pixelAt(tangent(0.49), 0.0)->u, 0);
  EXPECT_EQ(camera.pixelAt(tangent(0.51), 0.0)->u, 1);
  EXPECT_EQ(camera.pixelAt(tangent(c.width_px - 0.51), 0.0)->u, c.width_px - 1);
  EXPECT_FALSE(camera.pixelAt(tangent(-0.51), 0.0));
  EXPECT_FALSE(camera.pixelAt(tangent(c.width_px - 0.49), 0.0));
  EXPECT_FALSE(camera.pixelAt(kNaN, 0.0));
  EXPECT_FALSE(camera.pixelAt(0.0, kNaN));
}

TEST(CameraModel, ClassifiesRawValuesByRange) {
  CameraParameters c = smallCamera();
  c.no_return_values = {0, 65535, 4000};
  const CameraModel camera(c);
  EXPECT_EQ(camera.classify(0), DepthReading::kNone);
  EXPECT_EQ(camera.classify(65535), DepthReading::kNone);
  EXPECT_EQ(camera.classify(4000), DepthReading::kNone);
  EXPECT_EQ(camera.classify(199), DepthReading::kTooNear);
  EXPECT_EQ(camera.classify(201), DepthReading::kInRange);
  EXPECT_EQ(camera.classify(9999), DepthReading::kInRange);
  EXPECT_EQ(camera.classify(10001), DepthReading::kTooFar);
}

TEST(CameraModel, DepthFollowsTheUnit) {
  CameraParameters c = smallCamera();
  c.depth_unit_m = 0.0001;
  EXPECT_FLOAT_EQ(CameraModel(c).depth(10000), 1.0F);
}

class DistortedCamera : public testing::TestWithParam<Distortion> {
 protected:
  DistortedCamera() { parameters_.distortion = GetParam(); }
  CameraParameters parameters_ = smallCamera(160, 120);
};

TEST_P(DistortedCamera, RaysLandOnTheirPixelThroughTheForwardPolynomial) {
  const CameraModel camera(parameters_);
  for (int v = 0; v < camera.height(); v += 7) {
    for (int u = 0; u < camera.width(); u += 7) {
      const Vec3 ray_C = camera.deproject(static_cast<std::size_t>(v * camera.width() + u), 1000).cast<double>();
      const auto distorted = brownConrady(GetParam(), ray_C.x() / ray_C.z(), ray_C.y() / ray_C.z());
      EXPECT_NEAR(distorted.x() * parameters_.fx_px + parameters_.cx_px, u, 1e-4);
      EXPECT_NEAR(distorted.y() * parameters_.fy_px + parameters_.cy_px, v, 1e-4);
    }
  }
}

TEST_P(DistortedCamera, EveryTangentInTheFrustumHasItsPixelWithinOne) {
  const CameraModel camera(parameters_);
  const Frustum& f = camera.frustum();
  for (int i = 0; i <= 50; ++i) {
    for (int j = 0; j <= 50; ++j) {
      const double x = f.tan_left + i / 50.0 * (f.tan_right - f.tan_left);
      const double y = f.tan_top + j / 50.0 * (f.tan_bottom - f.tan_top);
      const auto pixel = camera.pixelAt(x, y);
      ASSERT_TRUE(pixel);
      const auto distorted = brownConrady(GetParam(), x, y);
      EXPECT_NEAR(pixel->u, distorted.x() * parameters_.fx_px + parameters_.cx_px, 1.5);
      EXPECT_NEAR(pixel->v, distorted.y() * parameters_.fy_px + parameters_.cy_px, 1.5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, DistortedCamera,
                         testing::Values(Distortion{.k1 = -0.05, .k2 = 0.01},  // barrel
                                         Distortion{.k1 = 0.08},               // pincushion
                                         Distortion{.k1 = -0.03, .p1 = 0.004, .p2 = -0.003, .k3 = 0.001}));

}  // namespace
}  // namespace nanomap
