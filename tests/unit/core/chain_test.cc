#include "core/chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time at(std::int64_t ms) { return Time(milliseconds(ms)); }

/// A fast flight: weaving, climbing, turning.
Pose truthAt(std::int64_t ms) {
  const double t_s = static_cast<double>(ms) / 1000.0;
  return {Quat(Eigen::AngleAxisd(0.8 * std::sin(1.5 * t_s), Vec3::UnitZ()) *
               Eigen::AngleAxisd(0.4 * std::sin(2.5 * t_s), Vec3::UnitY())),
          Vec3(8.0 * t_s, 2.0 * std::sin(2.0 * t_s), 1.5 + 0.3 * t_s)};
}

/// What a drifting estimator says: a yaw error and a position error that grow with time.
Pose driftedAt(std::int64_t ms) {
  const double t_s = static_cast<double>(ms) / 1000.0;
  const Pose T_W_truth{Quat(Eigen::AngleAxisd(0.02 * t_s, Vec3::UnitZ())), Vec3(0.1 * t_s, -0.2 * t_s, 0.05 * t_s)};
  return T_W_truth * truthAt(ms);
}

const Pose kJump{Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ())), Vec3(3.0, 1.0, -0.5)};

void expectSame(const Pose& a, const Pose& b, const char* what, double tolerance_m = 1e-9) {
  EXPECT_LT((a.translation_m - b.translation_m).norm(), tolerance_m) << what;
  EXPECT_LT(a.rotation.angularDistance(b.rotation), std::max(1e-7, tolerance_m)) << what;
}

/// A chain fed by a stream of poses (100 Hz) and views (about 30 Hz), both stamped in ms.
class ChainTest : public testing::Test {
 protected:
  using Motion = std::function<Pose(std::int64_t)>;

  explicit ChainTest(ChainParameters parameters = {}) : chain_(parameters) {}

  ViewPtr view(std::int64_t ms) const {
    DepthImage image = test::flatImage(*camera_, 5000, at(ms));
    image.sequence = static_cast<std::uint64_t>(ms);
    return test::viewOf(std::move(image), camera_);
  }
  static BodyPose pose(std::int64_t ms, const Pose& T_W_B, std::uint32_t epoch = 1) {
    return {
        .stamp = at(ms), .T_W_B = T_W_B, .epoch = epoch, .sequence = static_cast<std::uint64_t>(ms), .increment = {}};
  }
  /// Poses from_ms .. to_ms every 10 ms, and views every 33 ms that lie within.
  void fly(std::int64_t from_ms, std::int64_t to_ms, const Motion& motion, std::uint32_t epoch = 1) {
    for (std::int64_t ms = from_ms; ms <= to_ms; ++ms) {
      if (ms % 10 == 0) {
        EXPECT_EQ(chain_.addPose(pose(ms, motion(ms), epoch)).verdict, PoseVerdict::kAccepted);
      }
      if (ms % 33 == 0) (void)chain_.addView(view(ms));
    }
  }
  static Correction window(std::int64_t from_ms, std::int64_t to_ms, std::int64_t step_ms, const Motion& corrected,
                           std::uint32_t epoch = 1, std::uint64_t sequence = 1) {
    Correction correction{.epoch = epoch, .sequence = sequence, .poses = {}};
    for (std::int64_t ms = from_ms; ms <= to_ms; ms += step_ms) correction.poses.push_back({at(ms), corrected(ms)});
    return correction;
  }
  /// T_{C_older}_{C_newer} when the body moves by `motion`.
  [[nodiscard]] Pose edge(const Motion& motion, Time older, Time newer) const {
    const Pose T_B_C = camera_->parameters().T_B_C;
    return (motion(ms(older)) * T_B_C).inverse() * (motion(ms(newer)) * T_B_C);
  }
  static std::int64_t ms(Time time) { return toNanoseconds(time) / 1'000'000; }

  /// Checks every stored edge (all but edge 0): `expected(older, newer)` gives the motion it should follow.
  /// Tolerance: poses interpolated over 10 ms of a curved flight.
  void expectEdges(const std::function<Pose(Time, Time)>& expected, double tolerance_m) const {
    const ChainSnapshot snapshot = chain_.snapshot();
    const std::vector<Edge> edges = chain_.edges();
    ASSERT_EQ(edges.size(), snapshot.views.size());
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const Time older = snapshot.views[i].view->stamp();
      const Time newer = snapshot.views[i - 1].view->stamp();
      expectSame(edges[i].T_older_newer, expected(older, newer), std::to_string(ms(older)).c_str(), tolerance_m);
    }
  }
  [[nodiscard]] std::uint64_t dropped(ViewDrop reason) const {
    return chain_.counters().views_dropped[static_cast<std::size_t>(reason)];
  }

  /// Linear interpolation over 10 ms against the curve itself: acceleration * (10 ms)^2 / 8 with 20 m/s^2.
  static constexpr double kInterpolation_m = 1e-3;

  std::shared_ptr<const CameraModel> camera_ = [] {
    CameraParameters camera = test::smallCamera(8, 6);
    camera.T_B_C.translation_m = {0.1, 0.02, -0.05};  // a lever arm
    return test::model(camera);
  }();
  Chain chain_;
};

TEST_F(ChainTest, EdgesFollowTheMotionBetweenViews) {
  fly(0, 2000, truthAt);
  EXPECT_EQ(chain_.viewCount(), 61U);
  expectEdges([&](Time older, Time newer) { return edge(truthAt, older, newer); }, kInterpolation_m);
}

TEST_F(ChainTest, EveryPoseRefreshesTheFirstEdge) {
  fly(0, 1000, truthAt);
  const Pose T_B_C = camera_->parameters().T_B_C;
  for (const std::int64_t now_ms : {1010, 1020, 1500}) {
    (void)chain_.addPose(pose(now_ms, truthAt(now_ms)));
    const ChainSnapshot snapshot = chain_.snapshot();
    EXPECT_EQ(snapshot.stamp, at(now_ms));
    const Pose expected = (truthAt(990) * T_B_C).inverse() * truthAt(now_ms);
    expectSame(chain_.edges()[0].T_older_newer, expected, "edge 0", 1e-9);
    EXPECT_LT((snapshot.views[0].t_C_B_m - expected.translation_m).norm(), 1e-9);
  }
}

TEST_F(ChainTest, AViewWaitsForThePoseAfterIt) {
  (void)chain_.addPose(pose(0, truthAt(0)));
  const auto outcome = chain_.addView(view(5));
  EXPECT_TRUE(outcome.waiting);
  EXPECT_FALSE(outcome.drop);
  EXPECT_EQ(chain_.waitingCount(), 1U);
  EXPECT_TRUE(chain_.snapshot().views.empty());
  EXPECT_EQ(chain_.addPose(pose(10, truthAt(10))).views_inserted, 1U);
  EXPECT_EQ(chain_.waitingCount(), 0U);
  EXPECT_EQ(chain_.snapshot().views.size(), 1U);
}

TEST_F(ChainTest, ViewsThatWaitEnterInOrderOfTheirStamps) {
  (void)chain_.addPose(pose(0, truthAt(0)));
  for (const int ms : {30, 10, 20}) EXPECT_TRUE(chain_.addView(view(ms)).waiting);
  EXPECT_EQ(chain_.addPose(pose(50, truthAt(50))).views_inserted, 3U);
  const ChainSnapshot snapshot = chain_.snapshot();
  ASSERT_EQ(snapshot.views.size(), 3U);
  EXPECT_EQ(snapshot.views[0].view->stamp(), at(30));
  EXPECT_EQ(snapshot.views[2].view->stamp(), at(10));
}

TEST_F(ChainTest, ACloudBeforeAnyPoseIsDroppedWhenPosesBegin) {
  EXPECT_TRUE(chain_.addView(view(100)).waiting);
  EXPECT_TRUE(chain_.snapshot().views.empty());
  EXPECT_EQ(chain_.addPose(pose(200, truthAt(200))).views_inserted, 0U);
  EXPECT_EQ(dropped(ViewDrop::kNoPose), 1U);
  EXPECT_EQ(chain_.waitingCount(), 0U);
}

TEST_F(ChainTest, LateDuplicateAndFutureCloudsAreCounted) {
  fly(0, 1000, truthAt);
  const std::size_t views = chain_.viewCount();
  EXPECT_EQ(chain_.addView(view(985)).drop, ViewDrop::kLate);
  EXPECT_EQ(chain_.addView(view(990)).drop, ViewDrop::kDuplicate);
  EXPECT_EQ(chain_.addView(view(1501)).drop, ViewDrop::kFromFuture);
  EXPECT_TRUE(chain_.addView(view(1003)).waiting);
  EXPECT_EQ(chain_.addView(view(1003)).drop, ViewDrop::kDuplicate);
  EXPECT_EQ(chain_.viewCount(), views);
  EXPECT_EQ(chain_.counters().viewsDropped(), 4U);
}

TEST_F(ChainTest, ACloudInAGapOfThePosesIsDropped) {
  (void)chain_.addPose(pose(0, truthAt(0)));
  (void)chain_.addPose(pose(300, truthAt(300)));
  EXPECT_EQ(chain_.addView(view(150)).drop, ViewDrop::kPoseGap);
}

TEST_F(ChainTest, PosesThatGoBackwardsLoseNothing) {
  fly(0, 1000, truthAt);
  const auto before = chain_.edges();
  EXPECT_EQ(chain_.addPose(pose(505, truthAt(505))).verdict, PoseVerdict::kAccepted);
  EXPECT_EQ(chain_.addPose(pose(500, truthAt(500))).verdict, PoseVerdict::kDuplicate);
  EXPECT_EQ(chain_.snapshot().stamp, at(1000));
  EXPECT_EQ(chain_.edges().size(), before.size());
}

class BoundedChainTest : public ChainTest {
 protected:
  BoundedChainTest() : ChainTest({.history_views = 300, .waiting_views = 4}) {}
};

TEST_F(BoundedChainTest, HoldsTheNewestViews) {
  for (std::int64_t ms = 0; ms < 500; ++ms) {
    (void)chain_.addPose(pose(ms, truthAt(ms)));
    EXPECT_FALSE(chain_.addView(view(ms)).drop);
  }
  const ChainSnapshot snapshot = chain_.snapshot();
  ASSERT_EQ(snapshot.views.size(), 300U);
  EXPECT_EQ(snapshot.views.front().view->stamp(), at(499));
  EXPECT_EQ(snapshot.views.back().view->stamp(), at(200));
  EXPECT_EQ(chain_.counters().views_retired, 200U);
}

TEST_F(BoundedChainTest, TheOldestThatWaitsMakesRoom) {
  (void)chain_.addPose(pose(0, truthAt(0)));
  for (const int ms : {20, 30, 40, 50}) EXPECT_TRUE(chain_.addView(view(ms)).waiting);
  EXPECT_TRUE(chain_.addView(view(60)).waiting);
  EXPECT_EQ(chain_.addView(view(10)).drop, ViewDrop::kWaitingFull) << "older than all that wait";
  EXPECT_EQ(dropped(ViewDrop::kWaitingFull), 2U);
  EXPECT_EQ(chain_.addPose(pose(70, truthAt(70))).views_inserted, 4U);
  EXPECT_EQ(chain_.snapshot().views.back().view->stamp(), at(30));
}

TEST_F(ChainTest, AWindowThatEnded200msAgoCorrectsWhatLiesInsideAndKeepsTheRest) {
  fly(0, 2000, driftedAt);
  const auto before = chain_.edges();
  const std::int64_t from_ms = 500;
  const std::int64_t to_ms = 1800;
  ASSERT_EQ(chain_.addCorrection(window(from_ms, to_ms, 10, truthAt)), CorrectionVerdict::kAccepted);
  expectEdges(
      [&](Time older, Time newer) {
        const bool inside = older >= at(from_ms) && newer <= at(to_ms);
        return edge(inside ? Motion(truthAt) : Motion(driftedAt), older, newer);
      },
      kInterpolation_m);
  const auto after = chain_.edges();
  expectSame(after[0].T_older_newer, before[0].T_older_newer, "edge 0 lies behind the window");
  // Views every 33 ms: 528 .. 1782 lie inside, 39 of them.
  EXPECT_EQ(chain_.counters().edges_corrected, 38U);
}

TEST_F(ChainTest, ASnapshotNamesTheLastCorrectionAccepted) {
  fly(0, 1000, driftedAt);
  EXPECT_FALSE(chain_.snapshot().correction_sequence);
  ASSERT_EQ(chain_.addCorrection(window(0, 500, 10, truthAt, 1, 41)), CorrectionVerdict::kAccepted);
  ASSERT_EQ(chain_.addCorrection(window(0, 500, 10, truthAt, 1, 41)), CorrectionVerdict::kOutOfOrder);
  EXPECT_EQ(chain_.snapshot().correction_sequence, 41U);
}

TEST_F(ChainTest, ANewEdgeAcrossTheWindowsEndStartsFromTheCorrectedPose) {
  fly(0, 1000, driftedAt);
  // Corrected up to now, by a world shifted as a whole: relative motion stays that of the estimator.
  const auto shifted = [](std::int64_t ms) { return kJump * driftedAt(ms); };
  ASSERT_EQ(chain_.addCorrection(window(0, 1000, 10, shifted)), CorrectionVerdict::kAccepted);
  fly(1001, 1100, driftedAt);
  expectEdges([&](Time older, Time newer) { return edge(driftedAt, older, newer); }, kInterpolation_m);
}

TEST_F(ChainTest, CorrectionsAtTwoHertzKeepFastMotion) {
  fly(0, 3000, driftedAt);
  ASSERT_EQ(chain_.addCorrection(window(0, 3000, 500, truthAt)), CorrectionVerdict::kAccepted);
  // The delta itself is curved between its anchors: 0.02 rad/s of yaw error at 24 m, over 0.5 s. Interpolated poses
  // instead of deltas would flatten the weave by 0.5 m.
  expectEdges([&](Time older, Time newer) { return edge(truthAt, older, newer); }, 5e-3);
}

TEST_F(ChainTest, ACorrectionReachesViewsThatWait) {
  fly(0, 990, driftedAt);
  for (const int ms : {992, 1003}) (void)chain_.addView(view(ms));
  EXPECT_GT(chain_.waitingCount(), 0U);
  (void)chain_.addPose(pose(1000, driftedAt(1000)));
  ASSERT_EQ(chain_.addCorrection(window(0, 1000, 10, truthAt)), CorrectionVerdict::kAccepted);
  EXPECT_EQ(chain_.waitingCount(), 1U);
  (void)chain_.addPose(pose(1010, driftedAt(1010)));
  ASSERT_EQ(chain_.waitingCount(), 0U);
  const ChainSnapshot snapshot = chain_.snapshot();
  const auto edges = chain_.edges();
  ASSERT_EQ(snapshot.views[1].view->stamp(), at(992));
  expectSame(edges[2].T_older_newer, edge(truthAt, snapshot.views[2].view->stamp(), at(992)), "inside the window",
             kInterpolation_m);
  // 1003 lies behind the window: the last delta carries it.
  const Pose T_truth_drifted = truthAt(1000) * driftedAt(1000).inverse();
  const auto carried = [&](std::int64_t ms) { return ms <= 1000 ? truthAt(ms) : T_truth_drifted * driftedAt(ms); };
  expectSame(edges[1].T_older_newer, edge(carried, at(992), at(1003)), "carried", kInterpolation_m);
}

TEST_F(ChainTest, AJumpWithoutACorrectionNeverSubtractsAcrossIt) {
  fly(0, 1000, truthAt, 1);
  const std::size_t before = chain_.viewCount();
  const auto jumped = [](std::int64_t ms) { return kJump * truthAt(ms); };
  (void)chain_.addPose(pose(1010, jumped(1010), 2));
  EXPECT_TRUE(chain_.snapshot().views.empty()) << "no view of the new world yet";
  fly(1011, 1200, jumped, 2);
  EXPECT_EQ(chain_.viewCount(), before + 6) << "the old views are kept for a correction";
  const ChainSnapshot snapshot = chain_.snapshot();
  ASSERT_EQ(snapshot.views.size(), 6U) << "but not connected";
  EXPECT_EQ(snapshot.views.back().view->stamp(), at(1023));
  expectEdges([&](Time older, Time newer) { return edge(truthAt, older, newer); }, kInterpolation_m);
}

TEST_F(ChainTest, AViewTakenWhileTheWorldJumpsIsDropped) {
  (void)chain_.addPose(pose(0, truthAt(0), 1));
  (void)chain_.addPose(pose(10, kJump * truthAt(10), 2));
  EXPECT_EQ(chain_.addView(view(5)).drop, ViewDrop::kBetweenEpochs);
}

TEST_F(ChainTest, ALateCorrectionJoinsTheWorldsBeforeAndAfterAJump) {
  const auto jumped = [](std::int64_t ms) { return kJump * truthAt(ms); };
  fly(0, 1000, truthAt, 1);
  fly(1001, 1200, jumped, 2);
  ASSERT_EQ(chain_.snapshot().views.size(), 6U);
  // The window ended before the jump: the views between, of the old world, are reached by the carried delta.
  ASSERT_EQ(chain_.addCorrection(window(300, 900, 10, jumped, 2)), CorrectionVerdict::kAccepted);
  EXPECT_EQ(chain_.snapshot().views.size(), chain_.viewCount());
  expectEdges([&](Time older, Time newer) { return edge(truthAt, older, newer); }, kInterpolation_m);
  const Pose T_B_C = camera_->parameters().T_B_C;
  expectSame(chain_.edges()[0].T_older_newer, (truthAt(1188) * T_B_C).inverse() * truthAt(1200), "edge 0",
             kInterpolation_m);
}

TEST_F(ChainTest, ACorrectionThatComesBeforeTheFirstPoseOfItsWorldJoinsThemToo) {
  const auto jumped = [](std::int64_t ms) { return kJump * truthAt(ms); };
  fly(0, 1000, truthAt, 1);
  ASSERT_EQ(chain_.addCorrection(window(300, 900, 100, jumped, 2)), CorrectionVerdict::kAccepted);
  EXPECT_EQ(chain_.snapshot().views.size(), chain_.viewCount());
  fly(1001, 1200, jumped, 2);
  EXPECT_EQ(chain_.snapshot().views.size(), chain_.viewCount());
  expectEdges([&](Time older, Time newer) { return edge(truthAt, older, newer); }, kInterpolation_m);
}

TEST_F(ChainTest, AViewOnlyAnOlderCorrectionReachedStaysInItsWorld) {
  const auto jumped = [](std::int64_t ms) { return kJump * truthAt(ms); };
  fly(0, 1000, truthAt, 1);
  ASSERT_EQ(chain_.addCorrection(window(500, 1000, 10, jumped, 2, 1)), CorrectionVerdict::kAccepted);
  for (std::int64_t ms = 1010; ms <= 3000; ms += 10) (void)chain_.addPose(pose(ms, jumped(ms), 2));  // camera stalls
  ASSERT_EQ(chain_.addCorrection(window(2000, 2900, 10, jumped, 2, 2)), CorrectionVerdict::kAccepted);
  const ChainSnapshot snapshot = chain_.snapshot();
  ASSERT_FALSE(snapshot.views.empty());
  const Pose T_B_C = camera_->parameters().T_B_C;
  expectSame(chain_.edges()[0].T_older_newer, (truthAt(990) * T_B_C).inverse() * truthAt(3000), "edge 0");
}

TEST_F(ChainTest, BadCorrectionsAreNamedAndChangeNothing) {
  fly(0, 1000, driftedAt, 5);
  ASSERT_EQ(chain_.addCorrection(window(0, 900, 100, truthAt, 5, 7)), CorrectionVerdict::kAccepted);
  const auto before = chain_.edges();
  Correction not_finite = window(0, 900, 100, truthAt, 5, 8);
  not_finite.poses[3].T_W_B.translation_m.z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(chain_.addCorrection(not_finite), CorrectionVerdict::kNotFinite);
  EXPECT_EQ(chain_.addCorrection(Correction{.epoch = 5, .sequence = 8, .poses = {}}), CorrectionVerdict::kEmpty);
  EXPECT_EQ(chain_.addCorrection(window(0, 900, 100, truthAt, 4, 8)), CorrectionVerdict::kStaleEpoch);
  EXPECT_EQ(chain_.addCorrection(window(0, 900, 100, truthAt, 5, 7)), CorrectionVerdict::kOutOfOrder);
  EXPECT_EQ(chain_.addCorrection(window(5000, 5900, 100, truthAt, 5, 8)), CorrectionVerdict::kNoOverlap);
  const auto after = chain_.edges();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) expectSame(after[i].T_older_newer, before[i].T_older_newer, "edge");
  for (const auto verdict :
       {CorrectionVerdict::kAccepted, CorrectionVerdict::kNotFinite, CorrectionVerdict::kEmpty,
        CorrectionVerdict::kStaleEpoch, CorrectionVerdict::kOutOfOrder, CorrectionVerdict::kNoOverlap}) {
    EXPECT_EQ(chain_.counters().corrections[static_cast<std::size_t>(verdict)], 1U) << toString(verdict);
  }
}

struct DriftCase {
  GrowthLaw law;
  int frame_ms;
};

class AccumulatedDrift : public testing::TestWithParam<DriftCase> {};

TEST_P(AccumulatedDrift, AfterTheConfiguredTimeEqualsTheConfiguredDeviation) {
  ChainParameters parameters;
  parameters.history_views = 400;
  parameters.drift = {.horizontal_std_m = 0.7, .vertical_std_m = 0.2, .after = seconds(2), .law = GetParam().law};
  Chain chain(parameters);
  const auto camera = test::model(test::smallCamera(8, 6));
  for (int ms = 0; ms <= 2000; ++ms) {
    (void)chain.addPose({.stamp = at(ms), .T_W_B = truthAt(ms), .epoch = 0, .sequence = 0, .increment = {}});
    if (ms % GetParam().frame_ms == 0)
      (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000, at(ms)), camera));
  }
  const ChainSnapshot snapshot = chain.snapshot();
  const SnapshotView& oldest = snapshot.views.back();
  ASSERT_EQ(oldest.view->stamp(), at(0));
  const Mat3 R_C_W = (truthAt(0) * camera->parameters().T_B_C).inverse().rotation.toRotationMatrix();
  const Mat3 expected = R_C_W * Vec3(0.49, 0.49, 0.04).asDiagonal() * R_C_W.transpose();
  EXPECT_LT((oldest.edge_covariance_C_m2 - expected).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(LawsAndRates, AccumulatedDrift,
                         testing::Values(DriftCase{GrowthLaw::kSquareRoot, 100}, DriftCase{GrowthLaw::kSquareRoot, 10},
                                         DriftCase{GrowthLaw::kLinear, 100}, DriftCase{GrowthLaw::kLinear, 10}));

TEST(ChainIncrements, ReplaceTheLawWhereTheMessagesCarryThem) {
  ChainParameters parameters;
  parameters.drift = {.horizontal_std_m = 1.0, .vertical_std_m = 1.0, .after = seconds(1), .use_increments = true};
  Chain chain(parameters);
  const auto camera = test::model(test::smallCamera(8, 6));
  for (int ms = 0; ms <= 1000; ms += 10) {
    BodyPose pose{.stamp = at(ms), .T_W_B = truthAt(ms), .epoch = 0, .sequence = 0, .increment = {}};
    if (ms <= 500) pose.increment = DriftIncrement{Vec3(1e-4, 4e-4, 0.0).asDiagonal(), milliseconds(10)};
    (void)chain.addPose(pose);
    if (ms % 100 == 0) (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000, at(ms)), camera));
  }
  const ChainSnapshot snapshot = chain.snapshot();
  const Mat3 R_C_W = (truthAt(0) * camera->parameters().T_B_C).inverse().rotation.toRotationMatrix();
  // 0.5 s by the law (the variance of 1 m after 1 s), 50 increments before.
  const Mat3 expected = R_C_W * Vec3(0.5 + 50e-4, 0.5 + 200e-4, 0.5).asDiagonal() * R_C_W.transpose();
  EXPECT_LT((snapshot.views.back().edge_covariance_C_m2 - expected).norm(), 1e-9);
  EXPECT_EQ(chain.counters().increments_missing, 5U);
}

TEST(ChainParameters, ImpossibleOnesAreNamed) {
  ChainParameters parameters;
  parameters.history_views = 0;
  EXPECT_THROW(Chain{parameters}, std::invalid_argument);
  parameters = {};
  parameters.drift.horizontal_std_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Chain{parameters}, std::invalid_argument);
  parameters = {};
  parameters.drift.after = Duration::zero();
  EXPECT_THROW(Chain{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace nanomap
