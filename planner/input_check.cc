#include "planner/input_check.h"

#include <cmath>

#include "core/pose_buffer.h"

namespace nanomap {
namespace {

// Beyond these a message is wrong (a unit, a frame, a diverged filter), and the arithmetic that follows stays finite.
constexpr double kFarthest_m = 1e6;
constexpr double kFastest_m_s = 100.0;
constexpr double kHardest_m_s2 = 100.0;

/// False for NaN, too.
bool isWithin(const Vec3& value, double limit) { return (value.array().abs() <= limit).all(); }

}  // namespace

bool isPlausible(const VehicleState& state) {
  return checkPose(state.T_W_B) == PoseVerdict::kAccepted && isWithin(state.T_W_B.translation_m, kFarthest_m) &&
         isWithin(state.velocity_W_m_s, kFastest_m_s) && isWithin(state.acceleration_W_m_s2, kHardest_m_s2);
}

std::optional<Reason> stateFault(const VehicleState& state, const ChainSnapshot& snapshot, Time now,
                                 Duration max_state_age) {
  if (!isPlausible(state)) return Reason::kStateInvalid;
  const Duration age = now - state.stamp;
  if (age < Duration::zero() || age > max_state_age) return Reason::kStateOtherTime;
  if (!snapshot.views.empty() && snapshot.epoch != state.epoch) return Reason::kStateOtherEpoch;
  return std::nullopt;
}

std::optional<Reason> goalFault(const std::optional<Goal>& goal, const VehicleState& state) {
  if (!goal) return Reason::kNoGoal;
  const bool valid =
      isWithin(goal->position_W_m, kFarthest_m) && std::isfinite(goal->top_speed_m_s) && goal->top_speed_m_s > 0.0;
  if (!valid) return Reason::kGoalInvalid;
  if (goal->epoch != state.epoch) return Reason::kGoalOtherEpoch;
  return std::nullopt;
}

}  // namespace nanomap
