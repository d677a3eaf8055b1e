#include "core/classify.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <random>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::paint;
using test::viewOf;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Vec3 kTightBox(0.01, 0.01, 0.01);

/// 160 x 120 pixels, 90 degrees wide, 0.2 .. 10 m.
class Drawn : public testing::Test {
 protected:
  [[nodiscard]] Status status(const DepthImage& image, const Vec3& mean_C, const Vec3& half_size = kTightBox) const {
    return classify(*viewOf(image, camera_), mean_C, half_size, up_C_, options_);
  }
  /// The point at depth `z_m` on the ray of pixel (u, v).
  [[nodiscard]] Vec3 onRay(int u, int v, double z_m) const {
    const auto& c = camera_->parameters();
    return {(u - c.cx_px) / c.fx_px * z_m, (v - c.cy_px) / c.fy_px * z_m, z_m};
  }

  std::shared_ptr<const CameraModel> camera_ = test::model(test::smallCamera(160, 120));
  DepthImage wall_at_5m_ = flatImage(*camera_, 5000);
  Vec3 up_C_{0.0, -1.0, 0.0};  ///< a level camera
  QueryOptions options_;
};

TEST_F(Drawn, InFrontOfAWallIsFreeAndBehindItOccluded) {
  EXPECT_EQ(status(wall_at_5m_, onRay(80, 60, 3.0)), Status::kFree);
  EXPECT_EQ(status(wall_at_5m_, onRay(80, 60, 4.999)), Status::kFree);
  EXPECT_EQ(status(wall_at_5m_, onRay(80, 60, 5.0)), Status::kOccluded) << "on the wall is not in front of it";
  EXPECT_EQ(status(wall_at_5m_, onRay(80, 60, 7.0)), Status::kOccluded);
}

TEST_F(Drawn, OutsideTheFrustumHasAStatusForEverySide) {
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, -1.0}), Status::kBehind);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 0.0}), Status::kBehind);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 0.19}), Status::kBehind) << "nearer than the sensor sees";
  EXPECT_EQ(status(wall_at_5m_, {3.1, 0.0, 3.0}), Status::kOutsideFov);
  EXPECT_EQ(status(wall_at_5m_, {-3.1, 0.0, 3.0}), Status::kOutsideFov);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 2.4, 3.0}), Status::kOutsideFov);
  EXPECT_EQ(status(wall_at_5m_, {0.0, -2.4, 3.0}), Status::kOutsideFov);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 10.1}), Status::kBeyondRange);
}

TEST_F(Drawn, TheVehiclesOwnBubbleIsSeenByNoFrustum) {
  for (const Vec3& p_C : {Vec3(0.0, 0.0, 0.0), Vec3(0.3, 0.0, 0.0), Vec3(0.0, 0.0, -0.4)}) {
    EXPECT_EQ(status(wall_at_5m_, p_C), Status::kBehind);
  }
}

TEST_F(Drawn, ABoxThatReachesOutOfTheViewIsPartial) {
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 3.0}, {2.9, 0.01, 0.01}), Status::kFree);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 3.0}, {3.1, 0.01, 0.01}), Status::kPartial);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 3.0}, {0.01, 2.4, 0.01}), Status::kPartial);
  EXPECT_EQ(status(wall_at_5m_, {0.0, 0.0, 1.0}, {0.01, 0.01, 0.9}), Status::kPartial) << "nearer than the near plane";
  DepthImage far_wall = flatImage(*camera_, 9990);
  EXPECT_EQ(status(far_wall, {0.0, 0.0, 9.9}, {0.01, 0.01, 0.2}), Status::kPartial) << "beyond the far plane";
}

TEST_F(Drawn, AReturnBeyondTheRangeLeavesTheRayFree) {
  EXPECT_EQ(status(flatImage(*camera_, 30000), onRay(80, 60, 9.0)), Status::kFree);
}

TEST_F(Drawn, OpenSkyIsOpen) {
  EXPECT_EQ(status(flatImage(*camera_, 0), onRay(80, 60, 5.0)), Status::kOpen);
  DepthImage skyline = flatImage(*camera_, 0);
  paint(skyline, 0, 159, 70, 119, 8000);  // far ground, beyond 0.7 of the range
  EXPECT_EQ(status(skyline, onRay(80, 60, 5.0)), Status::kOpen);
}

/// Over flat ground the rows just above the horizon are sky, however low the vehicle flies.
TEST_F(Drawn, TheHorizonIsOpen) {
  DepthImage field = flatImage(*camera_, 0);
  for (int row = 62; row < 120; ++row) {
    const double depth_m = 1.0 * camera_->parameters().fy_px / (row - camera_->parameters().cy_px);  // at 1 m height
    if (depth_m < 10.0) paint(field, 0, 159, row, row, static_cast<std::uint16_t>(depth_m * 1000.0));
  }
  EXPECT_EQ(status(field, onRay(80, 60, 5.0)), Status::kOpen);
  EXPECT_EQ(status(field, onRay(80, 100, 1.0)), Status::kFree) << "over the ground";
  EXPECT_EQ(status(field, onRay(80, 100, 5.0)), Status::kOccluded) << "in the ground";
  up_C_ = {0.0, 1.0, 0.0};  // the same image upside down: a ceiling
  EXPECT_EQ(status(field, onRay(80, 60, 5.0)), Status::kHole);
}

TEST_F(Drawn, TheLevelFollowsTheRollOfTheCamera) {
  DepthImage image = flatImage(*camera_, 0);
  paint(image, 90, 95, 60, 60, 2000);  // 10 pixels to the right
  up_C_ = Vec3(-0.6, -0.8, 0.0);       // rolled: right is down
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kOpen);
  up_C_ = Vec3(0.6, -0.8, 0.0);
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kHole);
  up_C_ = Vec3(0.0, 0.0, 1.0);  // straight up: no level, everything near counts
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kHole);
}

TEST_F(Drawn, ABoxThatReachesOutOfTheSkyIsPartial) {
  EXPECT_EQ(status(flatImage(*camera_, 0), {0.0, 0.0, 3.0}, {3.1, 0.01, 0.01}), Status::kPartial);
}

TEST_F(Drawn, AHoleInAWallIsAHole) {
  DepthImage image = wall_at_5m_;
  paint(image, 70, 90, 50, 70, 0);
  EXPECT_EQ(status(image, onRay(80, 60, 3.0)), Status::kHole);
  EXPECT_EQ(status(image, onRay(80, 60, 7.0)), Status::kHole);
}

TEST_F(Drawn, GlassInAFrameIsAHole) {
  DepthImage image = flatImage(*camera_, 0);
  paint(image, 60, 62, 30, 90, 3000);  // a window frame, wider apart than it is thick
  paint(image, 98, 100, 30, 90, 3000);
  EXPECT_EQ(status(image, onRay(80, 60, 4.0)), Status::kHole);
}

TEST_F(Drawn, AThinBranchInTheSkyMakesItsSurroundingsAHole) {
  DepthImage image = flatImage(*camera_, 0);
  paint(image, 0, 159, 60, 60, 2000);
  EXPECT_EQ(status(image, onRay(80, 60, 1.0)), Status::kFree) << "in front of the branch";
  EXPECT_EQ(status(image, onRay(80, 60, 3.0)), Status::kOccluded) << "behind it";
  EXPECT_EQ(status(image, onRay(80, 80, 3.0)), Status::kHole) << "20 pixels under it";
  EXPECT_EQ(status(image, onRay(80, 93, 9.0)), Status::kOpen) << "33 pixels under it, far behind";
  EXPECT_EQ(status(image, onRay(80, 93, 3.0)), Status::kHole) << "33 pixels, 1.2 m under it";
  EXPECT_EQ(status(image, onRay(80, 114, 3.0)), Status::kOpen) << "54 pixels, 2 m under it";
  EXPECT_EQ(status(image, onRay(80, 58, 3.0)), Status::kOpen) << "above it";
}

TEST_F(Drawn, SomethingTooNearIsNeverSky) {
  DepthImage image = flatImage(*camera_, 100);  // 0.1 m, nearer than the range
  EXPECT_EQ(status(image, onRay(80, 60, 3.0)), Status::kOccluded);
  paint(image, 75, 85, 55, 65, 0);
  EXPECT_EQ(status(image, onRay(80, 60, 3.0)), Status::kHole);
}

/// Two metres wide, and the camera stands before it: all that is left of the wall is at the image's borders.
TEST_F(Drawn, APaneThatFillsTheViewIsAHole) {
  DepthImage image = flatImage(*camera_, 0);
  paint(image, 0, 3, 0, 119, 1300);
  paint(image, 156, 159, 0, 119, 1300);
  EXPECT_EQ(status(image, onRay(80, 60, 1.3)), Status::kHole);
  EXPECT_EQ(status(image, onRay(80, 60, 2.9)), Status::kOpen) << "the frame is too far aside";
  options_.open_frame_m = 1.0;
  EXPECT_EQ(status(image, onRay(80, 60, 1.3)), Status::kOpen);
}

TEST_F(Drawn, TheSkyWindowIsConfigured) {
  options_.open_frame_m = 0.0;
  DepthImage image = flatImage(*camera_, 0);
  paint(image, 100, 100, 60, 60, 3000);
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kHole);
  options_.open_window_px = 19;
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kOpen);
  options_.open_window_px = 32;
  options_.open_range_fraction = 0.25;
  EXPECT_EQ(status(image, onRay(80, 60, 5.0)), Status::kOpen);
}

TEST_F(Drawn, TheFootprintTestSeesAPoleBesideTheMean) {
  DepthImage image = flatImage(*camera_, 8000);
  paint(image, 90, 92, 0, 119, 2000);
  const Vec3 mean_C = onRay(80, 60, 4.0);
  const Vec3 box(0.6, 0.1, 0.1);  // 12 pixels to each side at 4 m
  EXPECT_EQ(status(image, mean_C, box), Status::kFree);
  options_.occlusion = OcclusionTest::kFootprint;
  EXPECT_EQ(status(image, mean_C, box), Status::kPartial);
  EXPECT_EQ(status(image, mean_C, {0.3, 0.1, 0.1}), Status::kFree) << "the footprint ends before the pole";
  EXPECT_EQ(status(wall_at_5m_, onRay(80, 60, 4.9), {0.01, 0.01, 0.2}), Status::kPartial) << "reaches into the wall";
}

TEST_F(Drawn, NotANumberIsNeverFree) {
  const DepthImage sky = flatImage(*camera_, 0);
  for (const DepthImage& image : {wall_at_5m_, sky}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 mean_C(0.0, 0.0, 3.0);
      mean_C[axis] = kNaN;
      const Status of_mean = status(image, mean_C);
      EXPECT_TRUE(of_mean == Status::kBehind || of_mean == Status::kOutsideFov) << toString(of_mean);
      Vec3 half_size = kTightBox;
      half_size[axis] = kNaN;
      EXPECT_EQ(status(image, {0.0, 0.0, 3.0}, half_size), Status::kPartial);
    }
  }
}

/// A box that is called free lies in the frustum with all of 10,000 points, corners among them; one whose corner
/// sticks out is not free.
TEST_F(Drawn, ContainmentAgreesWithSampledPoints) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const ViewPtr view = viewOf(flatImage(*camera_, 30000), camera_);
  const Frustum& f = camera_->frustum();
  const auto inFrustum = [&](const Vec3& p_C) {
    return p_C.z() >= f.near_m && p_C.z() <= f.far_m && p_C.x() >= f.tan_left * p_C.z() &&
           p_C.x() <= f.tan_right * p_C.z() && p_C.y() >= f.tan_top * p_C.z() && p_C.y() <= f.tan_bottom * p_C.z();
  };
  int free = 0;
  int partial = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double z_m = 5.1 + 4.9 * unit(random);
    const Vec3 mean_C(z_m * unit(random), 0.75 * z_m * unit(random), z_m);
    const Vec3 half_size = Vec3(unit(random), unit(random), unit(random)).cwiseAbs();
    bool corners_inside = true;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
      corners_inside = corners_inside && inFrustum(mean_C + half_size.cwiseProduct(sign));
    }
    const Status got = classify(*view, mean_C, half_size, up_C_, options_);
    if (!inFrustum(mean_C)) {
      EXPECT_TRUE(got == Status::kOutsideFov || got == Status::kBehind) << toString(got);
      continue;
    }
    EXPECT_EQ(got, corners_inside ? Status::kFree : Status::kPartial) << mean_C.transpose();
    ++(corners_inside ? free : partial);
    if (!corners_inside) continue;
    const Vec3 inner(unit(random), unit(random), unit(random));
    EXPECT_TRUE(inFrustum(mean_C + half_size.cwiseProduct(inner)));
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(partial, 1000);
}

}  // namespace
}  // namespace nanomap
