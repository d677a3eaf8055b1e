#pragma once

#include <optional>

#include "core/decision.h"
#include "core/vehicle_state.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/message_json.h"
#include "drivers/mavlink/setpoint.h"
#include "firmware_app/safety/heading_limiter.h"
#include "firmware_app/safety/motion_in_force.h"
#include "firmware_app/safety/state_machine.h"

namespace nanomap {

/// What the chain knows of the vehicle.
struct VehicleReport {
  bool camera = false;
  std::optional<VehicleState> state;  ///< at the newest pose
  std::optional<Time> newest_view;
};

/// What the planner gave last.
struct PlanReport {
  std::optional<Decision> in_force;  ///< the last one that may be flown
  Reason reason = Reason::kNoView;   ///< of the last one, whatever it was
};

/// All that the commander goes by at one moment.
struct CommandInputs {
  VehicleReport vehicle;
  PlanReport plan;
  AutopilotState autopilot;
  Alignment alignment;
  bool stalled = false;  ///< a thread of this process does not answer
};

/// What goes to the autopilot.
struct Command {
  Verdict verdict;
  std::optional<LocalNedTarget> target;  ///< empty: nothing is sent
  SystemStatus status = SystemStatus::kBoot;
};

/// Makes the setpoint of each moment: the state machine says which stream, the motion in force where to. A setpoint is
/// never repeated; each is sampled for its own moment.
/// A function of what it was given, in that order. Threads: one. Allocates: no.
class Commander {
 public:
  /// @param max_yaw_rate_rad_s  how fast the heading handed out turns
  /// @throws std::invalid_argument naming the parameter that is wrong
  Commander(const SafetyParameters& parameters, double max_yaw_rate_rad_s);

  [[nodiscard]] Command step(Time now, const CommandInputs& inputs);

  [[nodiscard]] const std::optional<Decision>& inForce() const { return motion_.decision(); }

 private:
  [[nodiscard]] Situation situationAt(Time now, const CommandInputs& inputs) const;
  [[nodiscard]] std::optional<LocalNedTarget> target(Time now, Stream stream, const CommandInputs& inputs);

  StateMachine machine_;
  MotionInForce motion_;
  HeadingLimiter heading_;
};

}  // namespace nanomap
