#include <gtest/gtest.h>

#include "core/chain.h"
#include "core/query.h"
#include "tests/support/allocations.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using std::chrono::milliseconds;

/// FLANN allocates three vectors a search, whatever the query; nothing of ours allocates.
TEST(Allocation, AQueryAllocatesOnlyInsideFlann) {
  const auto camera = test::model(test::smallCamera());
  ChainParameters parameters;
  parameters.history_views = 40;
  Chain chain(parameters);
  for (int i = 0; i < 40; ++i) {
    BodyPose pose;
    pose.stamp = Time(milliseconds(i * 30));
    pose.T_W_B.rotation = Eigen::AngleAxisd(0.05 * i, Vec3::UnitZ());
    (void)chain.addPose(pose);
    (void)chain.addView(test::viewOf(test::flatImage(*camera, 5000, pose.stamp), camera));
  }
  const ChainSnapshot snapshot = chain.snapshot();
  ASSERT_EQ(snapshot.views.size(), 40U);

  std::array<Neighbour, kMaxNeighbours> found;
  std::size_t before = test::allocationCount();
  (void)snapshot.views[0].view->index().nearest(Vec3f(0.0F, 0.0F, 3.0F), found);
  const std::size_t allocations_in_flann = test::allocationCount() - before;
  EXPECT_LE(allocations_in_flann, 3U);

  for (const Vec3& p_B : {Vec3(3.0, 0.0, 0.0), Vec3(0.0, -3.0, 0.0), Vec3(0.0, 0.0, 9.0), Vec3(30.0, 0.0, 0.0)}) {
    for (const OcclusionTest occlusion : {OcclusionTest::kMean, OcclusionTest::kFootprint}) {
      before = test::allocationCount();
      const QueryReply reply = query(snapshot, {p_B, 0.01 * Mat3::Identity()}, {.k = 16, .occlusion = occlusion});
      EXPECT_EQ(test::allocationCount() - before, allocations_in_flann)
          << p_B.transpose() << ' ' << toString(reply.status);
    }
  }

  std::array<UncertainPoint, 8> points_B{};
  std::array<QueryReply, 8> replies;
  before = test::allocationCount();
  queryBatch(snapshot, points_B, {}, replies);
  EXPECT_EQ(test::allocationCount() - before, points_B.size() * allocations_in_flann);
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

}  // namespace
}  // namespace nanomap
