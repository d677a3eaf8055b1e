#include "core/query.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <atomic>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include "core/chain.h"
#include "core/query_statistics.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using test::flatImage;
using test::viewOf;

constexpr unsigned kSeed = 3;

Mat3 randomCovariance(std::mt19937& random, double scale_m) {
  std::normal_distribution<double> normal(0.0, scale_m);
  Mat3 root;
  for (double& entry : root.reshaped()) entry = normal(random);
  return root * root.transpose();
}

/// A vehicle that turns on the spot at 90 degrees a second, an image every 100 ms: old views look elsewhere.
class TurningFlight : public testing::Test {
 protected:
  static constexpr int kViews = 12;
  static constexpr double kTurnRate_rad_s = std::numbers::pi / 2.0;

  TurningFlight() {
    ChainParameters parameters;
    parameters.history_views = kViews;
    parameters.drift = {.horizontal_std_m = 0.2, .vertical_std_m = 0.05, .after = std::chrono::seconds(1)};
    chain_.emplace(parameters);
    for (int i = 0; i < kViews; ++i) {
      EXPECT_EQ(chain_->addPose(poseAt(i * 100)).verdict, PoseVerdict::kAccepted);
      DepthImage image = flatImage(*camera_, 5000, Time(milliseconds(i * 100)));
      image.sequence = static_cast<std::uint64_t>(i);
      EXPECT_FALSE(chain_->addView(viewOf(image, camera_)).drop);
    }
    EXPECT_EQ(chain_->addPose(poseAt(kViews * 100 - 50)).verdict, PoseVerdict::kAccepted);
    snapshot_ = chain_->snapshot();
  }

  static BodyPose poseAt(int ms) {
    BodyPose pose;
    pose.stamp = Time(milliseconds(ms));
    const double t_s = ms / 1000.0;
    pose.T_W_B = {
        Quat(Eigen::AngleAxisd(kTurnRate_rad_s * t_s, Vec3::UnitZ()) * Eigen::AngleAxisd(0.3 * t_s, Vec3::UnitY())),
        Vec3(0.5 * t_s, 0.1, 2.0)};
    return pose;
  }

  std::shared_ptr<const CameraModel> camera_ = test::model(test::smallCamera());
  std::optional<Chain> chain_;
  ChainSnapshot snapshot_;
};

TEST(Query, WithoutAViewIsEmptyNotANumber) {
  const QueryReply reply = query(ChainSnapshot{}, UncertainPoint{{1.0, 0.0, 0.0}, Mat3::Zero()}, {});
  EXPECT_EQ(reply.status, Status::kEmpty);
  EXPECT_FALSE(reply.view_index);
  EXPECT_TRUE(reply.found().empty());
}

TEST_F(TurningFlight, AnswersFromTheNewestViewThatContainsThePoint) {
  const Vec3 ahead_B(3.0, 0.0, 0.0);
  const QueryReply now = query(snapshot_, {ahead_B, Mat3::Zero()}, {});
  EXPECT_EQ(now.status, Status::kFree);
  EXPECT_EQ(now.view_index, 0U);

  const Vec3 right_B = Eigen::AngleAxisd(-1.4, Vec3::UnitZ()) * ahead_B;  // left behind by the turn
  const QueryReply before = query(snapshot_, {right_B, Mat3::Zero()}, {});
  ASSERT_EQ(before.status, Status::kFree);
  ASSERT_TRUE(before.view_index);
  EXPECT_GT(*before.view_index, 3U);
  for (std::uint32_t newer = 0; newer < *before.view_index; ++newer) {
    const UncertainPoint x_C = snapshot_.views[newer].toCamera({right_B, Mat3::Zero()});
    const Vec3 half_size = x_C.covariance_m2.diagonal().cwiseSqrt();
    const Status status =
        classify(*snapshot_.views[newer].view, x_C.mean_m, half_size, snapshot_.views[newer].up_C, {});
    EXPECT_TRUE(status != Status::kFree && status != Status::kOpen) << newer;
  }
}

TEST_F(TurningFlight, APointThatNoViewContainsIsAnsweredByTheNewestWithItsStatus) {
  const QueryReply above = query(snapshot_, {{0.0, 0.0, 8.0}, Mat3::Zero()}, {.k = 3});
  EXPECT_TRUE(above.status == Status::kOutsideFov || above.status == Status::kBehind);
  EXPECT_EQ(above.view_index, 0U);
  EXPECT_EQ(above.found().size(), 3U);
}

TEST_F(TurningFlight, AWideBoxIsRefusedByTheViewThatContainsItsMean) {
  const UncertainPoint wide{{3.0, 0.0, 0.0}, Vec3(4.0, 25.0, 0.01).asDiagonal()};
  EXPECT_EQ(query(snapshot_, wide, {}).status, Status::kPartial);
}

/// Paper IV.A.1, step by step along the edges, with the rotation on both sides.
TEST_F(TurningFlight, ComposedTransformsEqualTheStepByStepSum) {
  std::mt19937 random(kSeed);
  const std::vector<Edge> edges = chain_->edges();
  ASSERT_EQ(edges.size(), snapshot_.views.size());
  for (int trial = 0; trial < 20; ++trial) {
    UncertainPoint x{Vec3::Random() * 5.0, randomCovariance(random, 0.3)};
    const UncertainPoint x_B = x;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Mat3 R = edges[i].T_older_newer.rotation.toRotationMatrix();
      x.mean_m = edges[i].T_older_newer * x.mean_m;
      x.covariance_m2 = edges[i].covariance_older_m2 + R * x.covariance_m2 * R.transpose();
      const UncertainPoint composed = snapshot_.views[i].toCamera(x_B);
      EXPECT_LT((composed.mean_m - x.mean_m).norm(), 1e-12);
      EXPECT_LT((composed.covariance_m2 - x.covariance_m2).norm(), 1e-12);
    }
  }
}

/// The covariance in an old view is that of points moved there through sampled noisy edges.
TEST_F(TurningFlight, PropagatedCovarianceAgreesWithMonteCarlo) {
  constexpr int kSamples = 40'000;
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  const auto draw = [&](const Mat3& covariance) -> Vec3 {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
    const Vec3 white(normal(random), normal(random), normal(random));
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().cwiseProduct(white);
  };
  const UncertainPoint x_B{{2.0, 1.0, 0.0}, randomCovariance(random, 0.1)};
  const std::vector<Edge> edges = chain_->edges();
  Vec3 sum = Vec3::Zero();
  Mat3 sum_sq = Mat3::Zero();
  for (int i = 0; i < kSamples; ++i) {
    Vec3 p = x_B.mean_m + draw(x_B.covariance_m2);
    for (const Edge& edge : edges) p = edge.T_older_newer * p + draw(edge.covariance_older_m2);
    sum += p;
    sum_sq += p * p.transpose();
  }
  const Vec3 mean = sum / kSamples;
  const Mat3 covariance = sum_sq / kSamples - mean * mean.transpose();
  const UncertainPoint expected = snapshot_.views.back().toCamera(x_B);
  const double std_m = std::sqrt(expected.covariance_m2.diagonal().maxCoeff());
  // 5 standard errors of a mean and of a variance.
  EXPECT_LT((mean - expected.mean_m).cwiseAbs().maxCoeff(), 5.0 * std_m / std::sqrt(kSamples));
  EXPECT_LT((covariance - expected.covariance_m2).cwiseAbs().maxCoeff(),
            5.0 * std_m * std_m * std::sqrt(2.0 / kSamples));
}

TEST_F(TurningFlight, ReturnsAsManyNeighboursAsAskedInOrder) {
  for (const int k : {1, 2, 10, 16}) {
    const QueryReply reply = query(snapshot_, {{3.0, 0.0, 0.0}, Mat3::Zero()}, {.k = k});
    ASSERT_EQ(reply.found().size(), static_cast<std::size_t>(k));
    for (std::size_t i = 1; i < reply.found().size(); ++i) {
      EXPECT_LE(reply.found()[i - 1].distance_m, reply.found()[i].distance_m);
    }
  }
}

void expectSame(const QueryReply& got, const QueryReply& expected) {
  EXPECT_EQ(got.status, expected.status);
  EXPECT_EQ(got.view_index, expected.view_index);
  EXPECT_EQ(got.x_C.mean_m, expected.x_C.mean_m);
  EXPECT_EQ(got.x_C.covariance_m2, expected.x_C.covariance_m2);
  ASSERT_EQ(got.neighbour_count, expected.neighbour_count);
  for (std::size_t i = 0; i < expected.found().size(); ++i) {
    EXPECT_EQ(got.found()[i].distance_m, expected.found()[i].distance_m);
  }
}

TEST_F(TurningFlight, ABatchEqualsItsQueries) {
  std::mt19937 random(kSeed);
  const QueryOptions options{.k = 4};
  QueryScratch scratch;
  for (const int count : {200, 0, 1, 20}) {  // a scratch that has seen more, too
    std::vector<UncertainPoint> points_B;
    for (int i = 0; i < count; ++i) points_B.push_back({Vec3::Random() * 6.0, randomCovariance(random, 0.1)});
    std::vector<QueryReply> replies(points_B.size());
    queryBatch(snapshot_, points_B, options, scratch, replies);
    for (std::size_t i = 0; i < points_B.size(); ++i) expectSame(replies[i], query(snapshot_, points_B[i], options));
  }
}

TEST_F(TurningFlight, ABatchKeepsTheNeighboursWithinEachPointsDistance) {
  std::mt19937 random(kSeed);
  const QueryOptions options{.k = 4};
  std::uniform_real_distribution<float> distance_m(0.0F, 6.0F);
  std::vector<UncertainPoint> points_B;
  std::vector<float> max_distances_m;
  for (int i = 0; i < 200; ++i) {
    points_B.push_back({Vec3::Random() * 6.0, randomCovariance(random, 0.1)});
    max_distances_m.push_back(distance_m(random));
  }
  std::vector<QueryReply> replies(points_B.size());
  QueryScratch scratch;
  queryBatch(snapshot_, points_B, options, scratch, replies, max_distances_m);
  int cut = 0;
  for (std::size_t i = 0; i < points_B.size(); ++i) {
    QueryReply expected = query(snapshot_, points_B[i], options);
    const std::uint32_t all = expected.neighbour_count;
    while (expected.neighbour_count > 0 && expected.found().back().distance_m > max_distances_m[i]) {
      --expected.neighbour_count;
    }
    if (expected.neighbour_count < all) ++cut;
    expectSame(replies[i], expected);
  }
  EXPECT_GT(cut, 20);
}

TEST(Query, ABatchWithoutAViewIsEmpty) {
  const std::array<UncertainPoint, 3> points_B{};
  std::array<QueryReply, 3> replies;
  QueryScratch scratch;
  queryBatch(ChainSnapshot{}, points_B, {}, scratch, replies);
  for (const QueryReply& reply : replies) EXPECT_EQ(reply.status, Status::kEmpty);
}

TEST_F(TurningFlight, ABatchLeavesNothingOfEarlierReplies) {
  const std::array<UncertainPoint, 1> points_B{UncertainPoint{Vec3(2.0, 0.0, 0.0), 0.01 * Mat3::Identity()}};
  std::array<QueryReply, 1> replies;
  QueryScratch scratch;
  queryBatch(snapshot_, points_B, {.certify = true}, scratch, replies);
  ASSERT_GT(replies[0].neighbour_count, 0U);
  ASSERT_TRUE(replies[0].certified);
  queryBatch(ChainSnapshot{}, points_B, {}, scratch, replies);
  expectSame(replies[0], query(ChainSnapshot{}, points_B[0], {}));
  EXPECT_FALSE(replies[0].certified);
}

TEST_F(TurningFlight, StatisticsTellHowFarBackAnswersCameFrom) {
  QueryStatistics statistics(kViews);
  EXPECT_EQ(statistics.shareContainedWithin(kViews), 0.0);
  const Vec3 right_B = Eigen::AngleAxisd(-1.4, Vec3::UnitZ()) * Vec3(3.0, 0.0, 0.0);
  for (const Vec3& p_B : {Vec3(3.0, 0.0, 0.0), Vec3(2.0, 0.0, 0.0), right_B, Vec3(0.0, 0.0, 8.0)}) {
    statistics.record(query(snapshot_, {p_B, Mat3::Zero()}, {}));
  }
  statistics.record(QueryReply{});
  EXPECT_EQ(statistics.total(), 5U);
  EXPECT_EQ(statistics.withStatus(Status::kFree), 3U);
  EXPECT_EQ(statistics.withStatus(Status::kEmpty), 1U);
  EXPECT_EQ(statistics.containedAtDepth()[0], 2U);
  EXPECT_DOUBLE_EQ(statistics.shareContainedWithin(1), 0.4);
  EXPECT_DOUBLE_EQ(statistics.shareContainedWithin(kViews), 0.6);
  EXPECT_DOUBLE_EQ(statistics.shareContainedWithin(10 * kViews), 0.6);
}

/// Readers keep their snapshot while the chain drops every view in it (ThreadSanitizer watches).
TEST_F(TurningFlight, ReadersAreUndisturbedByTheChainMovingOn) {
  const UncertainPoint x_B{{3.0, 0.0, 0.0}, Mat3::Zero()};
  const float expected_m = query(snapshot_, x_B, {}).found().front().distance_m;
  std::atomic<bool> done = false;
  std::atomic<int> wrong = 0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&, snapshot = snapshot_] {
      do {
        if (query(snapshot, x_B, {}).found().front().distance_m != expected_m) ++wrong;
      } while (!done);
    });
  }
  for (int i = kViews; i < 3 * kViews; ++i) {
    (void)chain_->addPose(poseAt(i * 100));
    (void)chain_->addView(viewOf(flatImage(*camera_, 2000, Time(milliseconds(i * 100))), camera_));
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(chain_->viewCount(), static_cast<std::size_t>(kViews));
}

TEST(NewestHolding, IsTheFirstViewWithThePlaceInItsFrustumWhateverItKnows) {
  const auto camera = test::model(test::smallCamera(96, 72));
  Chain chain(ChainParameters{});
  Time stamp(std::chrono::seconds(1));
  for (const double yaw_W_rad : {0.0, 0.0, 1.6, 3.1}) {  // the newest looks back
    (void)chain.addPose(
        {.stamp = stamp, .T_W_B = {Quat(Eigen::AngleAxisd(yaw_W_rad, Vec3::UnitZ())), Vec3::Zero()}, .increment = {}});
    (void)chain.addView(viewOf(flatImage(*camera, 0, stamp), camera));  // nothing but holes
    stamp += std::chrono::milliseconds(100);
  }
  const ChainSnapshot snapshot = chain.snapshot();
  const Vec3 behind_B(-3.0, 0.0, 0.0);
  EXPECT_EQ(newestHolding(snapshot, behind_B, 4), 2U);
  EXPECT_EQ(newestHolding(snapshot, behind_B, 3), 2U);
  EXPECT_EQ(newestHolding(snapshot, behind_B, 2), std::nullopt);
  EXPECT_EQ(newestHolding(snapshot, {3.0, 0.0, 0.0}, 4), 0U);
  EXPECT_EQ(newestHolding(snapshot, {0.0, 0.0, 3.0}, 4), std::nullopt);
}

}  // namespace
}  // namespace nanomap
