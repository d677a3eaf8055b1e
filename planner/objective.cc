#include "planner/objective.h"

#include <algorithm>

namespace nanomap {

double Objective::motionReward(const Vec3& standstill_W_m, double speed_m_s) const {
  const double progress_m = distance_m_ - (goal_.position_W_m - standstill_W_m).norm();
  const double excess_m_s = std::max(speed_m_s - goal_.top_speed_m_s, 0.0);
  return progress_m - parameters_.speed_weight_s2_m2 * excess_m_s * excess_m_s - altitudeCost(standstill_W_m.z());
}

double Objective::brakeReward(const Vec3& standstill_W_m) const {
  const double left_m = isAtGoal(standstill_W_m) ? 0.0 : (goal_.position_W_m - standstill_W_m).norm();
  return distance_m_ - left_m + parameters_.least_gain_m - altitudeCost(standstill_W_m.z());
}

double Objective::altitudeCost(double altitude_W_m) const {
  const double off_m = altitude_W_m - goal_.position_W_m.z();
  const bool in_band = altitude_W_m >= parameters_.min_altitude_W_m && altitude_W_m <= parameters_.max_altitude_W_m;
  return parameters_.altitude_weight_1_m2 * off_m * off_m + (in_band ? 0.0 : parameters_.out_of_band_cost);
}

}  // namespace nanomap
