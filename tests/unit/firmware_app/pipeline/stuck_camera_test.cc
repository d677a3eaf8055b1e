#include "firmware_app/pipeline/stuck_camera.h"

#include <gtest/gtest.h>

#include "tests/support/camera.h"
#include "tests/support/drawing.h"

namespace nanomap {
namespace {

class StuckCameraTest : public ::testing::Test {
 protected:
  /// A picture whose first pixel reads `raw`, all others 3000.
  bool see(std::uint16_t raw) {
    DepthImage image = test::flatImage(*camera_, 3000);
    image.pixels.front() = raw;
    return detector_.see(test::viewOf(image, camera_), state_);
  }
  bool seeAgain(int times) {
    bool stuck = false;
    for (int i = 0; i < times; ++i) stuck = see(3000);
    return stuck;
  }
  void move(double by_m) { state_->T_W_B.translation_m.x() += by_m; }

  std::shared_ptr<const CameraModel> camera_ = std::make_shared<const CameraModel>(test::smallCamera());
  StuckDepthParameters parameters_{.images = 3, .motion_m = 0.25, .turn_rad = 0.1};
  StuckCamera detector_{parameters_};
  std::optional<VehicleState> state_ = VehicleState{};
};

TEST_F(StuckCameraTest, NoiseIsAllThatItTakesNotToBeStuck) {
  for (std::uint16_t i = 0; i < 20; ++i) {
    move(0.2);
    EXPECT_FALSE(see(static_cast<std::uint16_t>(3000 + i % 2)));
  }
}

TEST_F(StuckCameraTest, SamePictureOfAMovingVehicleIsStuckAfterSoManyRepeats) {
  EXPECT_FALSE(see(3000));
  move(1.0);
  EXPECT_FALSE(seeAgain(2));
  EXPECT_TRUE(see(3000));
  EXPECT_TRUE(detector_.isStuck());
}

TEST_F(StuckCameraTest, SamePictureOfAStandingVehicleIsNot) {
  EXPECT_FALSE(seeAgain(100));
  move(0.25);
  EXPECT_FALSE(see(3000)) << "exactly at the limit";
  move(0.01);
  EXPECT_TRUE(see(3000));
}

TEST_F(StuckCameraTest, TurningIsMotion) {
  EXPECT_FALSE(seeAgain(100));
  state_->T_W_B.rotation = Quat(Eigen::AngleAxisd(0.11, Vec3::UnitZ()));
  EXPECT_TRUE(see(3000));
}

TEST_F(StuckCameraTest, StaysStuckWhereTheVehicleWasStoppedAndGoesWithTheFirstOtherPicture) {
  seeAgain(3);
  move(1.0);
  EXPECT_TRUE(seeAgain(50));
  EXPECT_FALSE(see(3001));
  move(1.0);
  EXPECT_FALSE(see(3002));
}

TEST_F(StuckCameraTest, JumpOfTheWorldIsNoMotion) {
  seeAgain(10);
  move(5.0);
  ++state_->epoch;
  EXPECT_FALSE(seeAgain(10));
  move(1.0);
  EXPECT_TRUE(see(3000));
  ++state_->epoch;
  EXPECT_TRUE(see(3000)) << "but no end of it either";
}

TEST_F(StuckCameraTest, EmptySkyIsNoFault) {
  for (int i = 0; i < 20; ++i) {
    move(1.0);
    EXPECT_FALSE(detector_.see(test::viewOf(test::flatImage(*camera_, 0), camera_), state_));
  }
}

TEST_F(StuckCameraTest, NothingIsKnownWithoutAPose) {
  state_.reset();
  EXPECT_FALSE(seeAgain(20));
}

TEST_F(StuckCameraTest, CanBeSwitchedOff) {
  parameters_.images = 0;
  StuckCamera never(parameters_);
  for (int i = 0; i < 20; ++i) {
    move(1.0);
    EXPECT_FALSE(never.see(test::viewOf(test::flatImage(*camera_, 3000), camera_), state_));
  }
}

}  // namespace
}  // namespace nanomap
