#include "core/vouched_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/open_sky.h"
#include "tests/support/drawing.h"
#include "tests/support/instruction_sets.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::paint;
using test::viewOf;

constexpr unsigned kSeed = 21;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr RadiiOfInterest kAnyRadius{0.0, kInfinity};
const Vec3 kUp_C(0.0, -1.0, 0.0);  // a level camera

/// The depth from which on a pixel's ray is unseen, straight from the definition; infinite for sky.
double unseenFrom_m(const View& view, int u, int v, double z_m, const QueryOptions& options) {
  constexpr int kEdge = DepthTiles::kEdge_px;
  const CameraModel& camera = view.camera();
  const auto isGap = [&](int at_u, int at_v) { return camera.classify(view.rawAt(at_u, at_v)) == DepthReading::kNone; };
  if (!isGap(u, v)) return static_cast<double>(camera.depth(view.rawAt(u, v)));
  const int left = u / kEdge * kEdge;
  const int top = v / kEdge * kEdge;
  const PixelRect tile{left, std::min(left + kEdge, camera.width()) - 1, top,
                       std::min(top + kEdge, camera.height()) - 1};
  if (isOpen(view, tile, z_m, kUp_C, options)) return kInfinity;

  double narrow_m = kInfinity;
  const auto along = [&](int du, int dv) {
    int begin = 0;
    int end = 0;
    const auto inside = [&](int i) {
      return u + i * du >= 0 && u + i * du < camera.width() && v + i * dv >= 0 && v + i * dv < camera.height();
    };
    while (inside(begin) && isGap(u + begin * du, v + begin * dv)) --begin;
    while (inside(end) && isGap(u + end * du, v + end * dv)) ++end;
    if (!inside(begin) || !inside(end) || end - begin - 1 > options.narrow_gap_px) return;
    for (const int i : {begin, end}) {
      narrow_m = std::min(narrow_m, static_cast<double>(camera.depth(view.rawAt(u + i * du, v + i * dv))));
    }
  };
  along(1, 0);
  along(0, 1);
  return narrow_m < kInfinity ? narrow_m : camera.frustum().near_m;
}

/// All pixels, in double precision.
double slowRadius_m(const View& view, const Vec3& p_C, const QueryOptions& options) {
  const CameraModel& camera = view.camera();
  const Frustum& f = camera.frustum();
  const auto side = [](double across_m, double z_m, double tangent) {
    return (across_m - tangent * z_m) / std::hypot(1.0, tangent);
  };
  const double inside_m = std::min({side(p_C.x(), p_C.z(), f.tan_left), -side(p_C.x(), p_C.z(), f.tan_right),
                                    side(p_C.y(), p_C.z(), f.tan_top), -side(p_C.y(), p_C.z(), f.tan_bottom),
                                    p_C.z() - f.near_m, f.far_m - p_C.z()});
  if (!(inside_m > 0.0)) return 0.0;
  double ray_m = kInfinity;
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u) {
      const double begin_m = unseenFrom_m(view, u, v, p_C.z(), options);
      if (begin_m == kInfinity) continue;
      const auto& tangents = camera.rayTangents(static_cast<std::size_t>(v * camera.width() + u));
      const Vec3 ray(static_cast<double>(tangents.x()), static_cast<double>(tangents.y()), 1.0);
      const double nearest_m = std::max(begin_m, p_C.dot(ray) / ray.squaredNorm());
      ray_m = std::min(ray_m, (nearest_m * ray - p_C).norm());
    }
  }
  const double pixel = camera.tileTangents().pixel();
  return std::max(std::min(inside_m, (ray_m - pixel * p_C.z()) / (1.0 + pixel)), 0.0);
}

/// Things of all depths in front of a far wall, wide gaps of all kinds, and single pixels without depth.
DepthImage clutter(const CameraModel& camera, std::mt19937& random) {
  DepthImage image = flatImage(camera, 9500);
  std::uniform_int_distribution<int> column(0, camera.width() - 1);
  std::uniform_int_distribution<int> row(0, camera.height() - 1);
  std::uniform_int_distribution<int> size(0, camera.width() / 4);
  std::uniform_int_distribution<int> depth(100, 12'000);
  for (int i = 0; i < 12; ++i) {
    const int u = column(random);
    const int v = row(random);
    const auto raw = static_cast<std::uint16_t>(i % 3 == 0 ? 0 : depth(random));
    const int u_end = std::min(u + size(random), camera.width() - 1);
    paint(image, u, u_end, v, std::min(v + size(random), camera.height() - 1), raw);
  }
  for (int i = 0; i < camera.width(); ++i) {
    const int u = column(random);
    const int v = row(random);
    paint(image, u, u, v, v, 0);
  }
  return image;
}

std::vector<CameraParameters> cameras() {
  CameraParameters distorted = test::smallCamera(101, 53);
  distorted.distortion = {-0.1, 0.02, 0.002, -0.001, 0.0};
  return {test::smallCamera(), test::smallCamera(101, 53), test::smallCamera(7, 5), test::smallCamera(160, 120),
          distorted};
}

Vec3 drawInFrustum(const CameraModel& camera, std::mt19937& random) {
  std::uniform_real_distribution<double> share;
  const Frustum& f = camera.frustum();
  const double z_m = 10.0 * share(random);
  return z_m * Vec3(std::lerp(f.tan_left, f.tan_right, share(random)),
                    std::lerp(f.tan_top, f.tan_bottom, share(random)), 1.0);
}

class VouchedBallOn : public testing::TestWithParam<std::int64_t> {
 protected:
  test::OnInstructionSet target_{GetParam()};
};

TEST_P(VouchedBallOn, HasTheRadiusThatAllPixelsLeaveItAndNoMore) {
  std::mt19937 random(kSeed);
  int positive = 0;
  for (const CameraParameters& parameters : cameras()) {
    const auto camera = test::model(parameters);
    for (int scene = 0; scene < 6; ++scene) {
      const ViewPtr view = viewOf(clutter(*camera, random), camera);
      QueryOptions options;
      options.open_window_px = scene % 2 == 0 ? 2 : 32;
      options.narrow_gap_px = scene % 3 * 4;
      for (int i = 0; i < 60; ++i) {
        const Vec3 p_C = drawInFrustum(*camera, random);
        const double expected_m = slowRadius_m(*view, p_C, options);
        const double radius_m = vouchedBall(*view, p_C, kUp_C, options, kAnyRadius).radius_m;
        ASSERT_LE(radius_m, expected_m + 1e-9) << p_C.transpose();
        ASSERT_GE(radius_m, expected_m - 1e-4) << p_C.transpose();
        // Wherever it looks first.
        const Vec3 anywhere_C = 1.5 * drawInFrustum(*camera, random);
        ASSERT_EQ(vouchedBall(*view, p_C, kUp_C, options, kAnyRadius, anywhere_C).radius_m, radius_m);
        positive += radius_m > 0.05;
      }
    }
  }
  EXPECT_GT(positive, 200);
}

/// Every point of the ball, by the pixel that it falls on.
TEST_P(VouchedBallOn, HoldsNothingThatWasNotSeen) {
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share;
  const auto camera = test::model(test::smallCamera(160, 120));
  const QueryOptions options{.open_window_px = 4};
  int balls = 0;
  for (int i = 0; i < 400; ++i) {
    const ViewPtr view = viewOf(clutter(*camera, random), camera);
    const Vec3 p_C = drawInFrustum(*camera, random);
    const double radius_m = vouchedBall(*view, p_C, kUp_C, options, kAnyRadius).radius_m;
    if (radius_m == 0.0) continue;
    ++balls;
    for (int sample = 0; sample < 300; ++sample) {
      const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
      const Vec3 q_C = p_C + radius_m * std::cbrt(share(random)) * direction;
      ASSERT_TRUE(q_C.z() >= camera->frustum().near_m && q_C.z() <= camera->frustum().far_m);
      const auto pixel = camera->pixelAt(q_C.x() / q_C.z(), q_C.y() / q_C.z());
      ASSERT_TRUE(pixel);
      ASSERT_LE(q_C.z(), unseenFrom_m(*view, pixel->u, pixel->v, p_C.z(), options)) << p_C.transpose();
    }
  }
  EXPECT_GT(balls, 100);
}

INSTANTIATE_TEST_SUITE_P(Target, VouchedBallOn, testing::ValuesIn(test::instructionSets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

/// 160 x 120 pixels, 90 degrees wide, 0.2 .. 10 m: a pixel is 1.8 % of the depth.
class Vouched : public testing::Test {
 protected:
  [[nodiscard]] double radius_m(const DepthImage& image, const Vec3& p_C,
                                const RadiiOfInterest& of_interest = kAnyRadius) const {
    return vouchedBall(*viewOf(image, camera_), p_C, kUp_C, options_, of_interest).radius_m;
  }

  std::shared_ptr<const CameraModel> camera_ = test::model(test::smallCamera(160, 120));
  DepthImage wall_at_6m_ = flatImage(*camera_, 6000);
  Vec3 ahead_C_{0.0, 0.0, 5.0};
  QueryOptions options_;
};

TEST_F(Vouched, IsLimitedByAWallTheSidesAndTheRange) {
  EXPECT_NEAR(radius_m(wall_at_6m_, ahead_C_), 0.9, 0.01) << "the wall, less a pixel";
  EXPECT_NEAR(radius_m(wall_at_6m_, {4.0, 0.0, 5.0}), 1.0 / std::sqrt(2.0), 1e-9) << "the right side";
  EXPECT_NEAR(radius_m(wall_at_6m_, {0.0, 0.0, 0.5}), 0.3, 1e-9) << "the near limit";
  EXPECT_NEAR(radius_m(flatImage(*camera_, 12'000), {0.0, 0.0, 9.5}), 0.5, 1e-9) << "the far limit";
  EXPECT_NEAR(radius_m(flatImage(*camera_, 0), {0.0, 0.0, 9.5}), 0.5, 1e-9) << "sky";
}

TEST_F(Vouched, ShadowsLimitItThoughNoReturnIsNear) {
  DepthImage image = flatImage(*camera_, 9900);
  paint(image, 100, 103, 0, 119, 1500);  // a post 0.4 m to the right, and its shadow
  const Vec3 behind_C(0.8, 0.0, 5.0);
  Neighbour nearest;
  ASSERT_EQ(viewOf(image, camera_)->index().nearest(behind_C.cast<float>(), std::span(&nearest, 1)), 1U);
  EXPECT_GT(nearest.distance_m, 3.0F);
  EXPECT_NEAR(radius_m(image, behind_C), 0.43, 0.06);
}

TEST_F(Vouched, AWideGapIsUnseenFromTheNearLimitOnAndANarrowOneFromItsNearestEnd) {
  DepthImage wide = wall_at_6m_;
  paint(wide, 100, 108, 40, 80, 0);
  EXPECT_NEAR(radius_m(wide, {0.8, 0.0, 4.0}), 0.19, 0.05);
  DepthImage narrow = wall_at_6m_;
  paint(narrow, 100, 107, 40, 80, 0);
  EXPECT_NEAR(radius_m(narrow, {0.8, 0.0, 4.0}), 1.9, 0.01);
  paint(narrow, 108, 110, 0, 119, 4000);  // what lies in front of one end may go on in the gap
  EXPECT_NEAR(radius_m(narrow, {0.8, 0.0, 4.0}), 0.19, 0.05);
  DepthImage next = wall_at_6m_;
  paint(next, 100, 103, 40, 80, 0);
  options_.narrow_gap_px = 3;
  EXPECT_NEAR(radius_m(next, {0.8, 0.0, 4.0}), 0.19, 0.05);
}

TEST_F(Vouched, AGapAtTheBorderIsWide) {
  DepthImage image = wall_at_6m_;
  paint(image, 0, 1, 0, 119, 0);
  EXPECT_LT(radius_m(image, {-2.5, 0.0, 3.0}), radius_m(wall_at_6m_, {-2.5, 0.0, 3.0}));
}

TEST_F(Vouched, AReturnNearerThanTheRangeHidesWhatIsBehindIt) {
  DepthImage image = wall_at_6m_;
  paint(image, 70, 90, 50, 70, 100);
  EXPECT_EQ(radius_m(image, ahead_C_), 0.0);
}

TEST_F(Vouched, PointsBehindSomethingOutsideOrNowhereHaveNone) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& p_C : {Vec3(0.0, 0.0, 6.5), Vec3(0.0, 0.0, 6.0), Vec3(6.0, 0.0, 5.0), Vec3(0.0, 0.0, -1.0),
                          Vec3(0.0, 0.0, 0.1), Vec3(0.0, 0.0, 11.0), Vec3(kNaN, 0.0, 5.0), Vec3(0.0, 0.0, kNaN),
                          Vec3(0.0, 0.0, kInfinity), Vec3(kInfinity, 0.0, 5.0)}) {
    EXPECT_EQ(radius_m(wall_at_6m_, p_C), 0.0) << p_C.transpose();
  }
}

TEST_F(Vouched, RadiiOutsideOfInterestAreCut) {
  const double all_m = radius_m(wall_at_6m_, ahead_C_);
  EXPECT_EQ(radius_m(wall_at_6m_, ahead_C_, {all_m - 0.01, kInfinity}), all_m);
  EXPECT_EQ(radius_m(wall_at_6m_, ahead_C_, {all_m, kInfinity}), 0.0);
  EXPECT_EQ(radius_m(wall_at_6m_, ahead_C_, {0.0, 0.4}), 0.4);
  EXPECT_EQ(radius_m(wall_at_6m_, ahead_C_, {0.4, 0.4}), 0.0);
  EXPECT_EQ(radius_m(wall_at_6m_, ahead_C_, {0.0, 0.0}), 0.0);
}

TEST_F(Vouched, NamesWhatLimitsIt) {
  const ViewPtr view = viewOf(wall_at_6m_, camera_);
  const VouchedBall at_wall = vouchedBall(*view, ahead_C_, kUp_C, options_, kAnyRadius);
  ASSERT_TRUE(at_wall.nearest_unseen_C);
  EXPECT_LT((*at_wall.nearest_unseen_C - Vec3(0.0, 0.0, 6.0)).norm(), 0.1);
  EXPECT_FALSE(vouchedBall(*view, ahead_C_, kUp_C, options_, {0.0, 0.4}).nearest_unseen_C);
}

}  // namespace
}  // namespace nanomap
