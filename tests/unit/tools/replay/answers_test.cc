#include "tools/replay/answers.h"

#include <gtest/gtest.h>

#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

TEST(Answers, OfAnEmptySnapshotHaveNoView) {
  const std::vector<UncertainPoint> points_B(2);
  const std::vector<QueryReply> replies(2);
  const answers_t message = toMessage(ChainSnapshot{}, points_B, replies, 1);
  EXPECT_EQ(message.num_views, 0);
  EXPECT_EQ(message.num_fan, 1);
  ASSERT_EQ(message.answers.size(), 2U);
  EXPECT_FALSE(message.answers[0].has_view);
  EXPECT_EQ(message.answers[0].status, static_cast<std::int8_t>(Status::kEmpty));
  EXPECT_EQ(message.answers[0].num_neighbours, 0);
}

TEST(Answers, CarryWhatTheQuerySaid) {
  const auto camera = test::model(test::smallCamera());
  DepthImage image = test::flatImage(*camera, 5000, Time(std::chrono::microseconds(123)));
  image.sequence = 9;
  ChainSnapshot snapshot;
  snapshot.stamp = Time(std::chrono::microseconds(456));
  snapshot.epoch = 2;
  snapshot.pose_sequence = 7;
  snapshot.T_W_B.translation_m = {1.0, 2.0, 3.0};
  const Pose T_C_B = camera->parameters().T_B_C.inverse();
  snapshot.views.push_back(
      {test::viewOf(image, camera), T_C_B.rotation.toRotationMatrix(), T_C_B.translation_m, 0.01 * Mat3::Identity()});
  Mat3 covariance_B;
  covariance_B << 0.04, 0.01, 0.0, 0.01, 0.05, 0.0, 0.0, 0.0, 0.06;
  const std::vector<UncertainPoint> points_B = {{{3.0, 0.5, 0.0}, covariance_B}};
  std::vector<QueryReply> replies(1);
  QueryOptions options;
  options.k = 2;
  queryBatch(snapshot, points_B, options, replies);
  ASSERT_EQ(replies[0].neighbour_count, 2U);

  const answers_t message = toMessage(snapshot, points_B, replies, 1);
  EXPECT_EQ(message.utime, 456);
  EXPECT_EQ(message.epoch, 2);
  EXPECT_EQ(message.pose_sequence, 7);
  EXPECT_EQ(message.world_from_body.translation[2], 3.0);
  const answer_t& answer = message.answers.at(0);
  EXPECT_EQ(answer.status, static_cast<std::int8_t>(Status::kFree));
  EXPECT_TRUE(answer.has_view);
  EXPECT_EQ(answer.view_index, 0);
  EXPECT_EQ(answer.view_sequence, 9);
  EXPECT_EQ(answer.view_utime, 123);
  EXPECT_EQ(answer.mean_body[1], 0.5);
  EXPECT_EQ(answer.covariance_body[1], 0.01);
  EXPECT_EQ(answer.covariance_body[8], 0.06);
  EXPECT_NEAR(answer.mean_camera[2], 3.0, 1e-12);
  EXPECT_NEAR(answer.covariance_camera[8], 0.05, 1e-12);
  ASSERT_EQ(answer.num_neighbours, 2);
  ASSERT_EQ(answer.neighbours.size(), 2U);
  EXPECT_EQ(answer.distances[0], replies[0].neighbours[0].distance_m);
  EXPECT_EQ(answer.neighbours[1][2], replies[0].neighbours[1].point_C.z());
}

}  // namespace
}  // namespace nanomap
