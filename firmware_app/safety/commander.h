#pragma once

#include <optional>

#include "core/decision.h"
#include "core/vehicle_state.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/setpoint.h"
#include "firmware_app/safety/feedforward.h"
#include "firmware_app/safety/heading_limiter.h"
#include "firmware_app/safety/motion_in_force.h"
#include "firmware_app/safety/state_machine.h"
#include "planner/motion_limits.h"

namespace nanomap {

/// What the chain knows of the vehicle.
struct VehicleReport {
  bool camera = false;
  bool camera_stuck = false;          ///< shows the same picture again and again, while the vehicle moves
  std::optional<VehicleState> state;  ///< at the newest pose
  std::optional<Time> newest_view;
};

/// What the planner gave last.
struct PlanReport {
  std::optional<Decision> in_force;  ///< the last one that may be flown
  std::uint64_t sequence = 0;        ///< of that one
  Time newest_view{};                ///< exposure of the newest frame that it knows
  Reason reason = Reason::kNoView;   ///< of the last one, whatever it was
};

/// All that the commander goes by at one moment.
struct CommandInputs {
  VehicleReport vehicle;
  PlanReport plan;
  AutopilotState autopilot;
  Alignment alignment;
  bool ending = false;               ///< this process has been told to end
  bool stalled = false;              ///< a thread of this process does not answer
  std::optional<Time> unsent_since;  ///< what should have been sent since then was refused
  bool recording = false;            ///< vehicle and plan are those of a recording: only a simulated autopilot is flown
};

/// What the autopilot is told, in the world of the motion in force; of a hold, in that of the poses.
struct CommandedMotion {
  Motion motion_W;
  double yaw_W_rad = 0.0;
  bool with_position = true;              ///< else only velocity and acceleration are told
  std::optional<std::uint64_t> decision;  ///< that it was sampled from, by the planner's count; empty for a hold
};

/// A recording to fly by, and an autopilot that does not say now that it flies no real vehicle, or is not heard at all:
/// it is told nothing.
[[nodiscard]] bool isRefused(const CommandInputs& inputs);

/// What goes to the autopilot.
struct Command {
  SafetyVerdict verdict;
  std::optional<CommandedMotion> motion;  ///< empty: nothing is sent
  LocalNedTarget target;                  ///< the same for the autopilot; of use with a motion
  SystemStatus status = SystemStatus::kBoot;
  bool plan_refused = false;  ///< the last plan's motion cannot be flown (isSound): a defect of ours
};

/// Makes the setpoint of each moment: the state machine says which stream, the motion in force where to. A setpoint is
/// never repeated; each is sampled for its own moment, which is when the autopilot acts on it, and leads by what the
/// vehicle is behind (Feedforward).
/// A function of what it was given, in that order. Threads: one. Allocates: no.
class Commander {
 public:
  /// @param limits              of every motion that is flown
  /// @param max_yaw_rate_rad_s  how fast the heading handed out turns
  /// @param feedforward         what the vehicle is behind its setpoints by
  /// @throws std::invalid_argument naming the parameter that is wrong
  Commander(const SafetyParameters& parameters, const MotionLimits& limits, double max_yaw_rate_rad_s,
            const Feedforward& feedforward, AutopilotWorld autopilot_world);

  [[nodiscard]] Command step(Time now, const CommandInputs& inputs);

  [[nodiscard]] const std::optional<Decision>& inForce() const { return in_force_.decision(); }

 private:
  /// @param plan_refused  as in Command
  [[nodiscard]] Situation situationAt(Time now, const CommandInputs& inputs, bool plan_refused) const;
  [[nodiscard]] std::optional<CommandedMotion> motion(Time now, Stream stream, const CommandInputs& inputs);
  /// From where the vehicle looks: a heading of another world leads nowhere in this one.
  void beginHeading(Time now, const VehicleState& state);

  StateMachine machine_;
  MotionLimits limits_;
  MotionInForce in_force_;
  HeadingLimiter heading_;
  std::uint32_t heading_epoch_ = 0;  ///< of the world that it is in
  Feedforward feedforward_;
};

}  // namespace nanomap
