#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "core/chain.h"
#include "core/query.h"
#include "core/view_pool.h"
#include "tests/support/allocations.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;

class AllocationIn : public testing::TestWithParam<IndexKind> {};

/// FLANN allocates three vectors a search, whatever the query; nothing of ours allocates.
TEST_P(AllocationIn, AQueryAllocatesOnlyInsideFlann) {
  const auto camera = test::model(test::smallCamera());
  ChainParameters parameters;
  parameters.history_views = 40;
  Chain chain(parameters);
  for (int i = 0; i < 40; ++i) {
    BodyPose pose;
    pose.stamp = Time(milliseconds(i * 30));
    pose.T_W_B.rotation = Eigen::AngleAxisd(0.05 * i, Vec3::UnitZ());
    (void)chain.addPose(pose);
    (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000, pose.stamp), camera, GetParam()));
  }
  const ChainSnapshot snapshot = chain.snapshot();
  ASSERT_EQ(snapshot.views.size(), 40U);

  std::array<Neighbour, kMaxNeighbours> found;
  std::size_t before = test::allocationCount();
  (void)snapshot.views[0].view->index().nearest(Vec3f(0.0F, 0.0F, 3.0F), found);
  const std::size_t allocations_in_flann = test::allocationCount() - before;
  EXPECT_LE(allocations_in_flann, GetParam() == IndexKind::kFlann ? 3U : 0U);

  for (const Vec3& p_B : {Vec3(3.0, 0.0, 0.0), Vec3(0.0, -3.0, 0.0), Vec3(0.0, 0.0, 9.0), Vec3(30.0, 0.0, 0.0)}) {
    for (const OcclusionTest occlusion : {OcclusionTest::kMean, OcclusionTest::kFootprint}) {
      for (const bool certify : {false, true}) {
        before = test::allocationCount();
        const QueryReply reply =
            query(snapshot, {p_B, 0.01 * Mat3::Identity()}, {.k = 16, .occlusion = occlusion, .certify = certify});
        EXPECT_EQ(test::allocationCount() - before, allocations_in_flann)
            << p_B.transpose() << ' ' << toString(reply.status);
      }
    }
  }

  std::array<UncertainPoint, 8> points_B{};
  std::array<QueryReply, 8> replies;
  QueryScratch scratch;
  queryBatch(snapshot, points_B, {}, scratch, replies);
  before = test::allocationCount();
  queryBatch(snapshot, points_B, {}, scratch, replies);
  EXPECT_EQ(test::allocationCount() - before, points_B.size() * allocations_in_flann);
}

INSTANTIATE_TEST_SUITE_P(Index, AllocationIn, testing::Values(IndexKind::kImage, IndexKind::kFlann));

CameraParameters paperSizedCamera() {
  CameraParameters camera = test::smallCamera(320, 240);
  camera.max_range_m = 20.0;
  return camera;
}

/// Images over which searches differ: nothing, one depth, two boxes in every tile.
std::vector<DepthImage> images(const CameraModel& camera) {
  std::mt19937 random(7);
  return {test::flatImage(camera, 0), test::flatImage(camera, 5000),
          test::randomImage(camera, random, 300, 19000, 0.3)};
}

TEST(Allocation, BuildingInAReusedSlotAndSearchingItAllocateNothing) {
  const auto camera = test::model(paperSizedCamera());
  const std::vector<DepthImage> frames = images(*camera);
  ViewPool pool(camera, IndexKind::kImage, 2);
  std::array<Neighbour, kMaxNeighbours> found;
  const std::size_t before = test::allocationCount();
  for (int i = 0; i < 20; ++i) {
    for (const DepthImage& frame : frames) {
      const ViewPtr view = std::get<ViewPtr>(pool.build(frame));
      for (const float max_distance_m : {0.5F, NearestPointIndex::kAnyDistance}) {
        for (const std::size_t k : {1U, 10U, 16U}) {
          (void)view->index().nearest(Vec3f(0.3F, -0.2F, 4.0F), std::span(found).first(k), max_distance_m);
        }
      }
    }
  }
  EXPECT_EQ(test::allocationCount(), before);
}

/// Everything that a history holds: pixels, index, tiles' bounds, the pool's own.
TEST(Allocation, AHistoryOf150ViewsTakesAtMost45Megabytes) {
  constexpr std::size_t kViews = 150;
  const auto camera = test::model(paperSizedCamera());
  const std::vector<DepthImage> frames = images(*camera);
  std::vector<ViewPtr> history;
  history.reserve(kViews);
  const std::size_t before = test::allocatedBytes();
  ViewPool pool(camera, IndexKind::kImage, kViews);
  for (std::size_t i = 0; i < kViews; ++i) history.push_back(std::get<ViewPtr>(pool.build(frames[i % frames.size()])));
  const std::size_t bytes = test::allocatedBytes() - before;
  EXPECT_EQ(pool.capacity(), kViews);
  EXPECT_LE(bytes, 45'000'000U);
  RecordProperty("bytes", std::to_string(bytes));
}

TEST(Allocation, PosesAndSnapshotsIntoUsedStorageAllocateNothing) {
  const auto camera = test::model(test::smallCamera());
  Chain chain(ChainParameters{});
  ChainSnapshot snapshot;
  BodyPose pose;
  (void)chain.addPose(pose);
  (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000), camera));
  chain.snapshotInto(snapshot);
  const std::size_t before = test::allocationCount();
  for (int i = 1; i < 10'000; ++i) {
    pose.stamp += milliseconds(10);
    (void)chain.addPose(pose);
    chain.snapshotInto(snapshot);
  }
  EXPECT_EQ(test::allocationCount(), before);
}

TEST(Allocation, CorrectionsOfSizesSeenBeforeAllocateNothing) {
  const auto camera = test::model(test::smallCamera());
  Chain chain(ChainParameters{});
  Correction correction;
  for (int i = 0; i < 100; ++i) {
    const BodyPose pose{.stamp = Time(milliseconds(10 * i)), .T_W_B = {}, .increment = {}};
    (void)chain.addPose(pose);
    if (i % 3 == 0) (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000, pose.stamp), camera));
    correction.poses.push_back({pose.stamp, pose.T_W_B});
  }
  const auto correct = [&] {
    ++correction.sequence;
    EXPECT_EQ(chain.addCorrection(correction), CorrectionVerdict::kAccepted);
  };
  for (int i = 0; i < 2; ++i) correct();  // one field is in force, one has room for the next
  const std::size_t before = test::allocationCount();
  for (int i = 0; i < 100; ++i) correct();
  EXPECT_EQ(test::allocationCount(), before);
}

}  // namespace
}  // namespace nanomap
