#include "tools/sim/flight_judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nanomap::sim {
namespace {

constexpr double kRadius_m = 0.4;

/// A pillar 5 m ahead of the start.
simulation::Scene pillar() {
  simulation::Mission mission;
  mission.start_W = {0.0, 0.0, 2.0};
  mission.goal_W = {10.0, 0.0, 2.0};
  return {"pillar", mission, {simulation::Cylinder{{5.0, 0.0, 0.0}, {5.0, 0.0, 10.0}, 0.5}}};
}

simulation::VehicleState at(const Vec3& p_W, double speed_m_s = 3.0) {
  simulation::VehicleState state;
  state.T_W_B.translation_m = p_W;
  state.velocity_W_m_s = {speed_m_s, 0.0, 0.0};
  return state;
}

Time second(int s) { return Time(std::chrono::seconds(s)); }

class FlightJudgeTest : public testing::Test {
 protected:
  simulation::Scene scene_ = pillar();
  FlightJudge judge_{scene_, kRadius_m};
};

TEST_F(FlightJudgeTest, SeesClearanceSpeedAndDeparture) {
  judge_.see(second(1), at({0.0, 0.0, 2.0}, 0.0), false);
  judge_.see(second(2), at({0.9, 0.0, 2.0}), false);
  EXPECT_FALSE(judge_.verdict().departure);
  judge_.see(second(3), at({3.0, 0.0, 2.0}, 5.0), false);
  judge_.see(second(4), at({5.0, 1.2, 2.0}, 4.0), false);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kUnderWay);
  EXPECT_EQ(judge_.verdict().departure, second(3));
  EXPECT_EQ(judge_.verdict().end, second(4));
  EXPECT_NEAR(judge_.verdict().flown_m, std::hypot(2.0, 1.2), 1e-9);
  EXPECT_NEAR(judge_.verdict().min_clearance_m, 0.7, 1e-9);
  EXPECT_EQ(judge_.verdict().top_speed_m_s, 5.0);
}

TEST_F(FlightJudgeTest, TouchingAnObstacleIsACollisionForGood) {
  judge_.see(second(1), at({0.0, 0.0, 2.0}), false);
  judge_.see(second(2), at({4.15, 0.0, 2.0}), false);
  judge_.see(second(3), at({9.0, 0.0, 2.0}, 0.0), true);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kCollision);
  EXPECT_EQ(judge_.verdict().end, second(2));
}

TEST_F(FlightJudgeTest, TouchingTheGroundIsACollisionOnlyAfterTakeOff) {
  judge_.see(second(1), at({0.0, 0.0, 0.0}, 0.0), false);
  judge_.see(second(2), at({0.0, 0.0, 0.39}), false);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kUnderWay);
  judge_.see(second(3), at({0.0, 0.0, 0.41}), false);
  EXPECT_GT(judge_.verdict().min_clearance_m, 1e3) << "it has not left its start";
  judge_.see(second(4), at({0.0, 0.0, 0.39}), false);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kCollision);
}

TEST_F(FlightJudgeTest, ArrivesOnlyWhenItStands) {
  judge_.see(second(1), at({9.0, 0.0, 2.0}, 1.0), true);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kUnderWay);
  judge_.see(second(2), at({9.0, 0.0, 2.0}, 0.1), false);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kUnderWay);
  judge_.see(second(3), at({9.0, 0.0, 2.0}, 0.1), true);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kAtGoal);
  judge_.see(second(4), at({9.0, 0.0, 2.0}, 0.1), true);
  EXPECT_EQ(judge_.verdict().end, second(3));
  judge_.see(second(5), at({5.85, 0.0, 2.0}, 0.1), true);
  EXPECT_EQ(judge_.verdict().outcome, Outcome::kCollision) << "who has arrived has to stay clear, too";
}

}  // namespace
}  // namespace nanomap::sim
