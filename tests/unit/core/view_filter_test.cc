#include "core/view_filter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "core/chain.h"
#include "core/query.h"
#include "tests/support/drawing.h"
#include "tests/support/drawn_world.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kSeed = 21;

/// The plain walk: every view in turn, in double precision.
Location walked(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options) {
  if (snapshot.views.empty()) return {};
  std::optional<Status> newest;
  for (std::uint32_t i = 0; i < snapshot.views.size(); ++i) {
    const SnapshotView& candidate = snapshot.views[i];
    const UncertainPoint x_C = candidate.toCamera(x_B);
    const Vec3 half_size = x_C.covariance_m2.diagonal().cwiseMax(0.0).cwiseSqrt();
    const Status status = classify(*candidate.view, x_C.mean_m, half_size, candidate.up_C, options);
    if (endsSearch(status)) return {status, i};
    if (i == 0) newest = status;
  }
  return {*newest, 0};
}

/// Runs `check` once with each vector unit that this machine has.
template <class Check>
void onEveryTarget(Check&& check) {
  for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
    const std::int64_t target = targets & -targets;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

enum class Cameras { kPinhole, kDistorted, kMixed };

/// A vehicle that weaves between blocks of stone and glass, looks around, and remembers.
class Weaving {
 public:
  Weaving(unsigned seed, int views, Cameras cameras) : random_(seed) {
    for (int i = 0; i < 12; ++i) {
      // Braces draw from left to right; of a call's arguments each compiler has an order of its own.
      const Vec3 low_W{draw(-8.0, 8.0), draw(-8.0, 8.0), draw(0.0, 1.0)};
      const Vec3 size_m{draw(0.2, 2.0), draw(0.2, 2.0), draw(0.5, 4.0)};
      world_.blocks.push_back({low_W, low_W + size_m, i % 4 == 0});
    }
    ChainParameters parameters;
    parameters.history_views = static_cast<std::size_t>(views);
    parameters.drift = {.horizontal_std_m = 0.3, .vertical_std_m = 0.1, .after = std::chrono::seconds(1)};
    Chain chain(parameters);
    const std::array models = {pinhole(), distorted(), fine()};
    for (int i = 0; i < views; ++i) {
      const Time stamp(milliseconds(33 * i));
      const Pose T_W_B = poseAt(i);
      EXPECT_EQ(chain.addPose({.stamp = stamp, .T_W_B = T_W_B, .increment = {}}).verdict, PoseVerdict::kAccepted);
      const auto& camera = models[cameras == Cameras::kMixed ? static_cast<std::size_t>(i) % models.size()
                                                             : static_cast<std::size_t>(cameras)];
      DepthImage image = world_.seenBy(*camera, T_W_B, stamp);
      for (std::uint16_t& raw : image.pixels) {
        if (draw(0.0, 1.0) < 0.01) raw = 0;
      }
      EXPECT_FALSE(chain.addView(std::make_shared<const View>(std::move(image), camera, nullptr)).drop);
    }
    snapshot_ = chain.snapshot();
    EXPECT_EQ(snapshot_.views.size(), static_cast<std::size_t>(views));
  }

  [[nodiscard]] const ChainSnapshot& snapshot() const { return snapshot_; }

  /// Around the vehicle, or on what a view saw: on a pixel's ray or border, at its depth or a hair from it.
  UncertainPoint point() {
    UncertainPoint x_B;
    if (draw(0.0, 1.0) < 0.5) {
      x_B.mean_m = {draw(-6.0, 9.0), draw(-6.0, 6.0), draw(-3.0, 3.0)};
    } else {
      const auto index = static_cast<std::size_t>(draw(0.0, static_cast<double>(snapshot_.views.size())));
      x_B.mean_m = seenPoint(snapshot_.views[index]);
    }
    const double scale_m = std::array{0.0, 0.003, 0.05, 0.5}[static_cast<std::size_t>(draw(0.0, 4.0))];
    Mat3 root;
    for (double& entry : root.reshaped()) entry = draw(-scale_m, scale_m);
    x_B.covariance_m2 = root * root.transpose();
    return x_B;
  }

 private:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Vec3 seenPoint(const SnapshotView& seen) {
    const CameraModel& camera = seen.view->camera();
    const Frustum& f = camera.frustum();
    const int u = static_cast<int>(draw(0.0, camera.width()));
    const int v = static_cast<int>(draw(0.0, camera.height()));
    const double border = draw(0.0, 1.0) < 0.3 ? 0.5 : 0.0;
    const double tan_x = std::lerp(f.tan_left, f.tan_right, (u + 0.5 + border) / camera.width());
    const double tan_y = std::lerp(f.tan_top, f.tan_bottom, (v + 0.5 - border) / camera.height());
    const double depth_m = static_cast<double>(camera.depth(seen.view->rawAt(u, v)));
    const double hair_m = std::array{0.0, 1e-12, 1e-7, 1e-4, 0.2}[static_cast<std::size_t>(draw(0.0, 5.0))];
    const double z_m = (depth_m > 0.0 ? depth_m : draw(0.0, 9.0)) + (draw(0.0, 1.0) < 0.5 ? hair_m : -hair_m);
    return seen.R_C_B.transpose() * (Vec3(tan_x * z_m, tan_y * z_m, z_m) - seen.t_C_B_m);
  }

  static Pose poseAt(int i) {
    const double t_s = 0.033 * i;
    return {Quat(Eigen::AngleAxisd(1.2 * std::sin(1.7 * t_s), Vec3::UnitZ()) *
                 Eigen::AngleAxisd(0.3 * std::sin(2.9 * t_s), Vec3::UnitY()) *
                 Eigen::AngleAxisd(0.4 * std::sin(2.3 * t_s), Vec3::UnitX())),
            Vec3(1.5 * t_s, std::sin(t_s), 1.5 + 0.5 * std::sin(0.7 * t_s))};
  }

  static std::shared_ptr<const CameraModel> pinhole() { return test::model(test::smallCamera()); }
  static std::shared_ptr<const CameraModel> distorted() {
    CameraParameters camera = test::smallCamera(101, 53);
    camera.distortion = {.k1 = -0.1, .k2 = 0.02, .p1 = 0.001, .p2 = -0.002};
    return test::model(camera);
  }
  /// A tenth of a millimetre a count: the range ends beyond the greatest raw value.
  static std::shared_ptr<const CameraModel> fine() {
    CameraParameters camera = test::smallCamera(80, 60);
    camera.depth_unit_m = 0.0001;
    camera.T_B_C.translation_m = {0.1, -0.05, 0.02};
    return test::model(camera);
  }

  std::mt19937 random_;
  test::DrawnWorld world_;
  ChainSnapshot snapshot_;
};

TEST(ViewFilter, NeverChangesAnAnswer) {
  std::array<int, kStatusCount> answers{};
  for (const Cameras cameras : {Cameras::kPinhole, Cameras::kDistorted, Cameras::kMixed}) {
    for (const int views : {1, 2, 16, 17, 90, 300}) {
      Weaving flight(kSeed + static_cast<unsigned>(views), views, cameras);
      std::vector<UncertainPoint> points_B(1500);
      for (UncertainPoint& x_B : points_B) x_B = flight.point();
      for (const QueryOptions& options :
           {QueryOptions{}, QueryOptions{.occlusion = OcclusionTest::kFootprint, .open_window_px = 9},
            QueryOptions{.margin_m = 0.4}}) {
        std::vector<Location> expected;
        for (const UncertainPoint& x_B : points_B) {
          expected.push_back(walked(flight.snapshot(), x_B, options));
          ++answers[static_cast<std::size_t>(expected.back().status)];
        }
        onEveryTarget([&] {
          for (std::size_t i = 0; i < points_B.size(); ++i) {
            const Location got = locate(flight.snapshot(), points_B[i], options);
            ASSERT_EQ(got, expected[i]) << i << ' ' << points_B[i].mean_m.transpose() << ": " << toString(got.status)
                                        << " instead of " << toString(expected[i].status);
          }
        });
      }
    }
  }
  for (std::size_t status = 0; status < static_cast<std::size_t>(Status::kEmpty); ++status) {
    EXPECT_GT(answers[status], 100) << toString(static_cast<Status>(status));
  }
}

/// Columns, rows or squares of near, far and nothing, and means that fall between two of them: what the filter takes
/// the pixel for need not be what it is.
TEST(ViewFilter, NeverTakesAPixelForItsNeighbour) {
  constexpr std::uint16_t kNear = 2000;
  constexpr std::uint16_t kFar = 8000;
  std::mt19937 random(kSeed);
  const auto pick = [&random](int below) { return std::uniform_int_distribution(0, below - 1)(random); };
  const auto camera = test::model(test::smallCamera());
  const Frustum& f = camera->frustum();
  int answered = 0;
  for (const auto& [width_px, height_px] : {std::pair{1, 48}, {64, 1}, {1, 1}, {8, 8}}) {
    DepthImage image = test::flatImage(*camera, kFar);
    for (int v = 0; v < camera->height(); v += height_px) {
      for (int u = 0; u < camera->width(); u += width_px) {
        const std::uint16_t raw =
            std::array{kNear, kNear, kFar, kFar, std::uint16_t{0}}[static_cast<std::size_t>(pick(5))];
        test::paint(image, u, std::min(u + width_px, camera->width()) - 1, v,
                    std::min(v + height_px, camera->height()) - 1, raw);
      }
    }
    ChainSnapshot snapshot;
    snapshot.views.resize(2);
    for (SnapshotView& view : snapshot.views) view.view = test::viewOf(image, camera);
    snapshot.views[0].R_C_B = Eigen::AngleAxisd(3.0, Vec3::UnitY()).toRotationMatrix();  // away from all points
    snapshot.filter.assign(snapshot.views);
    for (int i = 0; i < 2000; ++i) {
      constexpr double kHair = 1e-9;
      const double column = 1 + pick(camera->width() - 1) + (pick(2) == 0 ? 0.5 : kHair * (pick(3) - 1));
      const double row = 1 + pick(camera->height() - 1) + (pick(2) == 0 ? 0.5 : kHair * (pick(3) - 1));
      const double tan_x = std::lerp(f.tan_left, f.tan_right, column / camera->width());
      const double tan_y = std::lerp(f.tan_top, f.tan_bottom, row / camera->height());
      const double z_m = 3.0 + pick(4);
      const UncertainPoint x_B{{tan_x * z_m, tan_y * z_m, z_m}, Mat3::Zero()};
      const Location expected = walked(snapshot, x_B, {});
      if (expected.view_index == 1U) ++answered;
      onEveryTarget([&] { ASSERT_EQ(locate(snapshot, x_B, {}), expected) << column << ' ' << row; });
    }
  }
  EXPECT_GT(answered, 2000);
}

/// Views that are all alike leave a block's bound no slack but for rounding: points on the planes of their frustum, and
/// a few roundings to either side.
TEST(ViewFilter, PassesNoBlockOverThatHoldsThePoint) {
  const auto camera = test::model(test::smallCamera());
  const Frustum& f = camera->frustum();
  const ViewPtr view = test::viewOf(test::flatImage(*camera, 60000), camera);
  int answered = 0;
  for (const double far_away_m : {0.0, 1.0, 1e3, 1e5}) {
    for (const std::size_t views : {16U, 17U}) {
      ChainSnapshot snapshot;
      snapshot.views.resize(views + 1);
      for (SnapshotView& each : snapshot.views) {
        each.view = view;
        each.R_C_B = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
        each.t_C_B_m = far_away_m * Vec3(1.0, -0.7, 0.3);
      }
      snapshot.views[0].R_C_B = -snapshot.views[0].R_C_B;  // sees none of them
      snapshot.filter.assign(snapshot.views);
      for (const double z_m : {f.near_m, 2.0, f.far_m}) {
        for (const double tan_x : {f.tan_left, 0.0, f.tan_right}) {
          for (const double tan_y : {f.tan_top, 0.0, f.tan_bottom}) {
            for (int step = -4; step <= 4; ++step) {
              const double nudge = 1.0 + step * 0x1p-24;
              const Vec3 p_C(tan_x * z_m * nudge, tan_y * z_m * nudge, z_m * nudge);
              const SnapshotView& seen = snapshot.views.back();
              const UncertainPoint x_B{seen.R_C_B.transpose() * (p_C - seen.t_C_B_m), Mat3::Zero()};
              const Location expected = walked(snapshot, x_B, {});
              if (expected.view_index.value_or(0) > 0) ++answered;
              onEveryTarget([&] { ASSERT_EQ(locate(snapshot, x_B, {}), expected) << p_C.transpose(); });
            }
          }
        }
      }
    }
  }
  EXPECT_GT(answered, 500);
}

/// What makes the filter worth having: it leaves the views that answer, holes that only a look around tells from sky,
/// and hardly any other.
TEST(ViewFilter, LeavesFewViewsThatDoNotAnswer) {
  const QueryOptions options;
  Weaving flight(kSeed, 90, Cameras::kPinhole);
  int answering = 0;
  int others = 0;
  for (int i = 0; i < 5000; ++i) {
    const UncertainPoint x_B = flight.point();
    ViewFilter::Walk walk(flight.snapshot().filter, flight.snapshot().views.size(), x_B, options, 0);
    while (const auto index = walk.next()) {
      const Status status = classify(flight.snapshot().views[*index], x_B, {});
      if (endsSearch(status)) ++answering;
      if (!endsSearch(status) && status != Status::kHole) ++others;
    }
  }
  EXPECT_GT(answering, 40'000);
  EXPECT_LT(others, answering / 100);
}

TEST(ViewFilter, LeavesEverythingThatIsBeyondReason) {
  const QueryOptions options;
  Weaving flight(kSeed, 20, Cameras::kMixed);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto countLeft = [&options](const ChainSnapshot& snapshot, const UncertainPoint& x_B) {
    ViewFilter::Walk walk(snapshot.filter, snapshot.views.size(), x_B, options, 0);
    std::size_t count = 0;
    while (walk.next()) ++count;
    return count;
  };
  const UncertainPoint near{{2.0, 0.0, 0.0}, Mat3::Zero()};
  EXPECT_LT(countLeft(flight.snapshot(), {{-500.0, 0.0, 0.0}, Mat3::Zero()}), 1U);
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e30}) {
    for (int entry = 0; entry < 12; ++entry) {
      UncertainPoint x_B = near;
      (entry < 3 ? x_B.mean_m[entry] : x_B.covariance_m2((entry - 3) / 3, entry % 3)) = bad;
      EXPECT_EQ(countLeft(flight.snapshot(), x_B), 20U) << bad << ' ' << entry;
      EXPECT_EQ(locate(flight.snapshot(), x_B, {}), walked(flight.snapshot(), x_B, {}));
    }
    ChainSnapshot snapshot = flight.snapshot();
    snapshot.views[3].t_C_B_m.y() = bad;
    snapshot.filter.assign(snapshot.views);
    EXPECT_TRUE(snapshot.filter.empty());
    EXPECT_EQ(countLeft(snapshot, near), 20U);
  }
}

TEST(ViewFilter, OfNoViewsIsEmpty) {
  const QueryOptions options;
  ViewFilter filter;
  EXPECT_TRUE(filter.empty());
  filter.assign({});
  EXPECT_TRUE(filter.empty());
  ViewFilter::Walk walk(filter, 0, {}, options, 0);
  EXPECT_FALSE(walk.next());
}

}  // namespace
}  // namespace nanomap
