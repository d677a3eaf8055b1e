#pragma once

#include <optional>

#include "core/decision.h"
#include "core/goal.h"
#include "core/time.h"
#include "core/vehicle_state.h"

namespace nanomap {

struct DetourParameters {
  Duration patience = std::chrono::seconds(2);        ///< with a vehicle that comes no nearer to its goal
  double turn_rate_rad_s = 0.8;                       ///< how fast the course turns away from the goal, and back
  double lean_rad = 0.6;                              ///< of the course towards what is gone round, from where it flies
  Duration give_up_after = std::chrono::seconds(60);  ///< of one attempt; 0: there is none
  double return_m = 3.0;     ///< back where it began: within this, having left it by twice as much
  double near_goal_m = 3.0;  ///< held up nearer to its goal, a vehicle finds no way round
};

/// The memory of a way round what is wider than one plan sees (Pledge's algorithm). A vehicle that comes no nearer to
/// its goal is steered for a goal that is turned about it, ever farther to one side while nothing there is safe either;
/// once it moves, the course leans back from its motion towards the obstacle, so that it follows its edge, and rounds
/// it. The turn is counted, not wrapped: the detour is over when it has come back to nothing nearer to the goal than it
/// began, or has come a good deal nearer. An attempt that leads back to where it began, turns without end or takes too
/// long is given up for one to the other side, and that one for good, until something else brings the vehicle nearer or
/// the goal is moved: a goal that is closed in is not flown around for ever. Which course is safe is the planner's
/// business alone. A function of what it was given, in that order. Allocates: no. Threads: one.
class Detour {
 public:
  explicit Detour(const DetourParameters& parameters) : parameters_(parameters) {}

  /// The goal to steer for from `start`: `goal`, or what is to be taken for it on a detour, which near the goal has a
  /// lower top speed, too. A goal of another world or place than the last one starts anew; small shifts, as of a goal
  /// that is corrected for drift, do not.
  /// @param start  of increasing stamps; finite, in the goal's world
  [[nodiscard]] Goal steer(const VehicleState& start, const Goal& goal);

  /// What a plan for that goal came to.
  void note(Reason reason) { last_reason_ = reason; }

  [[nodiscard]] bool isTurned() const { return attempt_ && attempt_->turn_rad > 0.0; }

 private:
  struct Attempt {
    double side = 1.0;  ///< that the course turns to: 1 left, -1 right
    double turn_rad = 0.0;
    Vec3 began_W_m = Vec3::Zero();
    Time began{};
    double distance_m = 0.0;  ///< to the goal, at the least, when it began
    bool left = false;        ///< where it began
  };

  void watchProgress(Time now, Duration elapsed, double distance_m);
  void follow(const VehicleState& start, const Vec3& to_goal_W_m, Duration elapsed);
  [[nodiscard]] bool isInVain(const VehicleState& start);
  void begin(const VehicleState& start, double side);

  DetourParameters parameters_;
  std::optional<Goal> goal_;
  std::optional<Reason> last_reason_;
  Time last_stamp_{};
  double least_distance_m_ = 0.0;  ///< to the goal, so far
  Time last_progress_{};
  int attempts_ = 0;  ///< since then
  std::optional<Attempt> attempt_;
};

}  // namespace nanomap
