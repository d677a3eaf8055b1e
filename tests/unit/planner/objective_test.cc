#include "planner/objective.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

Goal goalAhead() {
  Goal goal;
  goal.position_W_m = {10.0, 0.0, 2.0};
  goal.top_speed_m_s = 4.0;
  return goal;
}

const Objective kObjective(ObjectiveParameters{}, goalAhead(), {0.0, 0.0, 2.0});

TEST(Objective, CountsProgressAtTheStandstill) {
  EXPECT_DOUBLE_EQ(kObjective.motionReward({3.0, 0.0, 2.0}, 4.0), 3.0);
  EXPECT_DOUBLE_EQ(kObjective.motionReward({-3.0, 0.0, 2.0}, 4.0), -3.0);
}

TEST(Objective, CostsSpeedAboveTheTopAndHeightOffTheGoals) {
  EXPECT_DOUBLE_EQ(kObjective.motionReward({10.0, 0.0, 2.0}, 6.0), 10.0 - 2.0 * 4.0);
  EXPECT_DOUBLE_EQ(kObjective.motionReward({10.0, 0.0, 3.0}, 0.0), 10.0 - 1.0 - 0.2);
  EXPECT_DOUBLE_EQ(kObjective.motionReward({10.0, 0.0, 0.0}, 0.0), 10.0 - 2.0 - 0.8 - 10.0);
}

TEST(Objective, ABrakeAtTheGoalIsWorthMoreThanAnyMotion) {
  EXPECT_GT(kObjective.brakeReward({9.6, 0.0, 2.0}), kObjective.motionReward({10.0, 0.0, 2.0}, 0.0));
  EXPECT_LT(kObjective.brakeReward({9.4, 0.0, 2.0}), kObjective.motionReward({9.5, 0.0, 2.0}, 0.0));
}

TEST(Objective, FlyingOnMustGainMoreThanALittle) {
  EXPECT_GT(kObjective.brakeReward({0.0, 0.0, 2.0}), kObjective.motionReward({0.04, 0.0, 2.0}, 0.0));
  EXPECT_LT(kObjective.brakeReward({0.0, 0.0, 2.0}), kObjective.motionReward({0.06, 0.0, 2.0}, 0.0));
}

TEST(Objective, NoRiskMakesAnythingBetter) {
  for (const double reward : {-5000.0, -1000.0, -0.1, 0.0, 3.0}) {
    double before = reward;
    for (const double risk : {0.0, 1e-17, 1e-9, 3e-4, 1e-3, 1.0}) {
      EXPECT_LE(kObjective.value(reward, risk), before);
      before = kObjective.value(reward, risk);
    }
  }
  EXPECT_DOUBLE_EQ(kObjective.value(3.0, 0.5), 0.5 * 3.0 - 0.5 * 1000.0);
}

}  // namespace
}  // namespace nanomap
