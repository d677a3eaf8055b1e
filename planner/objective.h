#pragma once

#include <algorithm>

#include "core/goal.h"
#include "core/trajectory.h"

namespace nanomap {

/// Weights of the objective (WAFR 2016, section on the objective). One unit is worth a metre of progress.
struct ObjectiveParameters {
  double speed_weight_s2_m2 = 2.0;    ///< times the square of the speed above the goal's top speed
  double altitude_weight_1_m2 = 0.2;  ///< times the square of the height above or below the goal
  double min_altitude_W_m = 0.5;      ///< of the band to stay in
  double max_altitude_W_m = 10.0;     ///< the paper's own flight starts at 5 m, where its authors' band ends
  double out_of_band_cost = 10.0;
  double collision_reward = -1000.0;  ///< a collision probability of 0.001 costs about a metre
  double goal_tolerance_m = 0.5;      ///< a standstill this near is at the goal
  double least_gain_m = 0.05;         ///< flying on must be worth this much more than stopping
};

/// What a candidate is worth: (goal progress - speed cost - altitude cost) (1 - P) + collision reward * P.
/// Progress is how much nearer to the goal the vehicle stands after the candidate's brake than it is now: that
/// standstill is what the plan guarantees. (The authors brake from 0.5 s of every motion: set the brake's delay to
/// 0.5 s for theirs.) The height is that of the standstill too; the speed is that where braking begins.
class Objective {
 public:
  Objective(const ObjectiveParameters& parameters, const Goal& goal, const Vec3& position_W_m)
      : parameters_(parameters), goal_(goal), distance_m_((goal.position_W_m - position_W_m).norm()) {}

  /// Of a motion that flies on, or of what is left of one: worth without any risk. @param standstill_W_m  after its
  /// brake
  [[nodiscard]] double motionReward(const Vec3& standstill_W_m, double speed_m_s) const;

  /// Of braking now: no speed cost, the least gain on top, so that a vehicle that is blocked stands and looks around
  /// instead of creeping, and all of the way counts as made if it ends at the goal, so that one that has arrived stays.
  [[nodiscard]] double brakeReward(const Vec3& standstill_W_m) const;

  [[nodiscard]] bool isAtGoal(const Vec3& standstill_W_m) const {
    return (goal_.position_W_m - standstill_W_m).norm() <= parameters_.goal_tolerance_m;
  }

  /// With the risk weighed in: never above the reward, and less the greater the risk, in floating point too, though a
  /// collision may seem better than what is worth less (a goal 80 m above).
  [[nodiscard]] double value(double reward, double risk) const {
    return reward + std::min(parameters_.collision_reward - reward, 0.0) * risk;
  }

 private:
  [[nodiscard]] double altitudeCost(double altitude_W_m) const;

  ObjectiveParameters parameters_;
  Goal goal_;
  double distance_m_;
};

}  // namespace nanomap
