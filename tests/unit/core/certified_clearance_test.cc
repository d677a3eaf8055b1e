#include "core/certified_clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/chain.h"
#include "core/query.h"
#include "core/vouched_ball.h"
#include "tests/support/drawn_world.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kSeed = 22;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Past two blocks, turning to the left and back: most of what is beside the vehicle was seen from farther back.
class FlightPastBlocks : public testing::Test {
 protected:
  static constexpr int kViews = 40;

  FlightPastBlocks() {
    ChainParameters parameters;
    parameters.history_views = kViews;
    parameters.drift = {.horizontal_std_m = 0.1, .vertical_std_m = 0.05, .after = std::chrono::seconds(1)};
    Chain chain(parameters);
    for (int i = 0; i < kViews; ++i) {
      const Time stamp{milliseconds(i * 33)};
      const double t_s = toSeconds(stamp.time_since_epoch());
      T_W_B_ = {Quat(Eigen::AngleAxisd(0.3 * std::sin(3.0 * t_s), Vec3::UnitZ())), Vec3(5.0 * t_s, 0.0, 2.0)};
      EXPECT_EQ(chain.addPose({.stamp = stamp, .T_W_B = T_W_B_, .increment = {}}).verdict, PoseVerdict::kAccepted);
      EXPECT_FALSE(chain.addView(test::viewOf(world_.seenBy(*camera_, T_W_B_, stamp), camera_)).drop);
    }
    snapshot_ = chain.snapshot();
  }

  [[nodiscard]] Vec3 drawAround(std::mt19937& random) const {
    std::uniform_real_distribution<double> coordinate_m(-3.0, 3.0);
    const double x_m = coordinate_m(random);
    const double y_m = coordinate_m(random);
    return {x_m + 1.0, y_m, 0.5 * coordinate_m(random)};
  }

  test::DrawnWorld world_{{{{5.0, 2.0, 0.0}, {6.0, 2.6, 5.0}}, {{9.0, -2.0, 0.0}, {9.5, -1.2, 5.0}}}};
  std::shared_ptr<const CameraModel> camera_ = test::model(test::smallCamera(160, 120));
  Pose T_W_B_;
  ChainSnapshot snapshot_;
  QueryOptions options_;
};

/// Views one after the other, each asked for all of its ball.
CertifiedClearance everyView(const ChainSnapshot& snapshot, const Vec3& p_B, const QueryOptions& options) {
  CertifiedClearance largest;
  for (std::uint32_t i = 0; i < snapshot.views.size(); ++i) {
    const SnapshotView& view = snapshot.views[i];
    const double std_m = std::sqrt(largestVarianceBound(view.edge_covariance_C_m2));
    const double vouched_m =
        vouchedBall(*view.view, view.R_C_B * p_B + view.t_C_B_m, view.up_C, options, {0.0, kInfinity}).radius_m;
    const double radius_m = vouched_m - options.certify_sigmas * std_m;
    const bool answers = endsSearch(classify(view, {p_B, Mat3::Zero()}, options));
    if (answers && radius_m > largest.radius_m) largest = {radius_m, vouched_m, i};
  }
  return largest;
}

TEST_F(FlightPastBlocks, IsTheLargestThatAnyViewGives) {
  std::mt19937 random(kSeed);
  int deep = 0;
  int none = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p_B = drawAround(random);
    options_.certify_sigmas = i % 3;
    const CertifiedClearance expected = everyView(snapshot_, p_B, options_);
    const CertifiedClearance found = certifiedClearance(snapshot_, p_B, options_, kInfinity);
    ASSERT_EQ(found.radius_m, expected.radius_m) << p_B.transpose();
    ASSERT_EQ(found.vouched_m, expected.vouched_m);
    ASSERT_EQ(found.view_index, expected.view_index);
    none += found.view_index ? 0 : 1;
    deep += found.view_index.value_or(0) > 10 ? 1 : 0;
  }
  EXPECT_GT(deep, 50);
  EXPECT_GT(none, 5);
}

TEST_F(FlightPastBlocks, AFilterSavesTimeOnly) {
  std::mt19937 random(kSeed);
  ChainSnapshot unfiltered = snapshot_;
  unfiltered.filter = {};
  for (int i = 0; i < 50; ++i) {
    const Vec3 p_B = drawAround(random);
    EXPECT_EQ(certifiedClearance(unfiltered, p_B, options_, 2.0).radius_m,
              certifiedClearance(snapshot_, p_B, options_, 2.0).radius_m);
  }
}

/// The poses are exact here, and the blocks larger than a pixel.
TEST_F(FlightPastBlocks, NothingIsNearerThanCertifiedThoughTheNearestNeighbourIsFarther) {
  std::mt19937 random(kSeed);
  options_.certify_sigmas = 0.0;
  int over = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p_B = drawAround(random);
    const double truth_m = world_.clearance_m(T_W_B_ * p_B);
    options_.certify = true;
    const QueryReply reply = query(snapshot_, {p_B, Mat3::Zero()}, options_);
    ASSERT_TRUE(reply.certified);
    EXPECT_LE(reply.certified->radius_m, truth_m + 0.001) << p_B.transpose();
    if (reply.found().empty()) continue;
    EXPECT_LE(reply.certified->radius_m, static_cast<double>(reply.found().front().distance_m));
    over += static_cast<double>(reply.found().front().distance_m) > truth_m + 0.5;
  }
  EXPECT_GT(over, 50);
}

TEST_F(FlightPastBlocks, ALimitIsReachedAsSoonAsOneViewDoes) {
  const Vec3 ahead_B(3.0, 0.0, 0.0);
  ASSERT_GT(certifiedClearance(snapshot_, ahead_B, options_, kInfinity).radius_m, 0.25);
  const CertifiedClearance limited = certifiedClearance(snapshot_, ahead_B, options_, 0.2);
  EXPECT_NEAR(limited.radius_m, 0.2, 1e-12);
  EXPECT_EQ(certifiedClearance(snapshot_, ahead_B, options_, 0.0).radius_m, 0.0);
}

TEST_F(FlightPastBlocks, OnlyOnRequestAndNothingWithoutAView) {
  const UncertainPoint ahead_B{{3.0, 0.0, 0.0}, Mat3::Zero()};
  EXPECT_FALSE(query(snapshot_, ahead_B, {}).certified);
  const QueryReply empty = query(ChainSnapshot{}, ahead_B, {.certify = true});
  ASSERT_TRUE(empty.certified);
  EXPECT_EQ(empty.certified->radius_m, 0.0);
  EXPECT_FALSE(empty.certified->view_index);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(certifiedClearance(snapshot_, {3.0, kNaN, 0.0}, options_, kInfinity).radius_m, 0.0);
}

}  // namespace
}  // namespace nanomap
