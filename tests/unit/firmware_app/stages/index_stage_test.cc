#include "firmware_app/stages/index_stage.h"

#include <gtest/gtest.h>

#include "firmware_app/stages/hand_overs.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;

class IndexStageTest : public ::testing::Test {
 protected:
  void giveCamera(Time arrival) {
    hand_overs_.cameras.push([&](ArrivedCamera& slot) { slot = {arrival, {"front", test::smallCamera()}}; });
  }
  void giveFrame(Time arrival) {
    const DepthImage image = test::flatImage(CameraModel(test::smallCamera()), 3000, arrival);
    hand_overs_.captured.push([&](ArrivedFrame& slot) { slot = {arrival, {}, {"front", image}}; });
  }
  std::optional<InputKind> nextKind() {
    std::optional<InputKind> kind;
    hand_overs_.indexed.pop([&](const IndexedFrame& indexed) { kind = indexed.kind; });
    return kind;
  }

  HandOvers hand_overs_{1};
  IndexStage stage_{ViewBuilder(std::nullopt),
                    {hand_overs_.cameras, hand_overs_.captured, hand_overs_.indexed, hand_overs_.chain_bell,
                     hand_overs_.index_counters}};
};

TEST_F(IndexStageTest, CameraComesFirstAndTheNewestFrameIsTold) {
  EXPECT_EQ(stage_.run(), 0U);
  EXPECT_FALSE(stage_.newestFrame());
  giveFrame(Time(2s));
  giveCamera(Time(1s));
  EXPECT_EQ(stage_.run(), 2U);
  EXPECT_EQ(nextKind(), InputKind::kCamera);
  EXPECT_EQ(nextKind(), InputKind::kDepth);
  EXPECT_EQ(stage_.newestFrame(), Time(2s));
}

TEST_F(IndexStageTest, CameraModelWaitsForRoomAndFramesAreDropped) {
  giveCamera(Time(1s));
  stage_.run();
  for (std::size_t i = 1; i < hand_overs_.indexed.capacity(); ++i) {
    giveFrame(Time(2s) + std::chrono::milliseconds(i));
    stage_.run();
  }
  giveCamera(Time(3s));
  giveFrame(Time(4s));
  stage_.run();
  EXPECT_EQ(hand_overs_.indexed.dropped(), 1U) << "the frame";
  EXPECT_EQ(hand_overs_.cameras.size(), 1U);
  while (nextKind()) {
  }
  stage_.run();
  EXPECT_EQ(nextKind(), InputKind::kCamera);
  EXPECT_EQ(hand_overs_.indexed.dropped(), 1U);
}

}  // namespace
}  // namespace nanomap
