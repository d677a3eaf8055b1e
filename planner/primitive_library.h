#pragma once

#include <array>
#include <cstdint>

#include "core/trajectory.h"
#include "planner/motion_limits.h"

namespace nanomap {

/// Candidates of every plan, by stable index: the library, then two that are always there; and one more while
/// something is in force.
inline constexpr std::uint32_t kVerticalLevels = 5;
inline constexpr std::uint32_t kRings = 3;
inline constexpr std::uint32_t kDirections = 8;
inline constexpr std::uint32_t kLibrarySize = kVerticalLevels * (1 + kRings * kDirections);
inline constexpr std::uint32_t kGoalDirected = kLibrarySize;
inline constexpr std::uint32_t kBrake = kLibrarySize + 1;
inline constexpr std::uint32_t kCandidateCount = kLibrarySize + 2;
inline constexpr std::uint32_t kBrakeInForce = kCandidateCount;  ///< what is left of the motion in force and its brake
inline constexpr std::uint32_t kMostCandidates = kCandidateCount + 1;
static_assert(kLibrarySize == 125);

/// Whether the candidate is its own brake.
[[nodiscard]] constexpr bool isStop(std::uint32_t index) { return index >= kBrake; }

/// The library's accelerations, in frame L. Index order: vertical level from down to up, in it the centre and then the
/// rings from the innermost outwards, in a ring the directions from straight ahead to the left.
/// Threads: immutable, any number of readers.
class PrimitiveLibrary {
 public:
  PrimitiveLibrary();

  /// Acceleration [m/s^2, L] of primitive `index` for a vehicle that starts at `speed_m_s`. @pre index < kLibrarySize
  [[nodiscard]] Vec3 acceleration_L(std::uint32_t index, const MotionLimits& limits, double speed_m_s) const;

 private:
  std::array<Vec3, kLibrarySize> unit_accelerations_L_;  ///< 1 is the limit of each of the two directions
};

/// How the goal-directed primitive closes in.
struct GoalDirectedParameters {
  double approach_s = 1.0;  ///< wanted speed: the distance in this time, up to the top speed
  double response_s = 0.5;  ///< in which the velocity would reach the wanted one
};

/// Acceleration [m/s^2] towards the wanted velocity, shortened to the limits with its direction kept horizontally.
/// `to_goal_m` and `velocity_m_s` are in one frame with z up, which is the result's frame too.
[[nodiscard]] Vec3 goalDirectedAcceleration(const Vec3& to_goal_m, const Vec3& velocity_m_s, double top_speed_m_s,
                                            const GoalDirectedParameters& parameters, const MotionLimits& limits);

struct PrimitiveTimes {
  double push_s = 0.0;     ///< when the acceleration begins to go back to zero
  double horizon_s = 0.0;  ///< when the primitive ends
};

/// From the motion at the start, a linear ramp to `acceleration_W_m_s2`, held until the push ends; then a ramp to zero,
/// and straight on to the horizon, which cuts whatever is not over yet.
[[nodiscard]] Trajectory primitive(Time start, const Motion& at_start_W, const Vec3& acceleration_W_m_s2,
                                   const PrimitiveTimes& times, const MotionLimits& limits);

}  // namespace nanomap
