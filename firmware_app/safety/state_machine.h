#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/time.h"
#include "firmware_app/safety/fault.h"
#include "firmware_app/safety/safety_parameters.h"

namespace nanomap {

// clang-format off
/// Who flies, and how well we could.
///
/// | state   | stream                    | leaves for | when                                                      |
/// |---------|---------------------------|------------|-----------------------------------------------------------|
/// | Waiting | none                      | Ready      | no fault for `settle`                                     |
/// | Ready   | hold where the vehicle is | Waiting    | a fault                                                   |
/// |         |                           | Flying     | the pilot has switched to external control since we became|
/// |         |                           |            | Ready, has not left it since, and the vehicle is armed    |
/// | Flying  | the motion in force       | Braking    | a fault                                                   |
/// |         |                           | Waiting    | the pilot has left external control, or has disarmed      |
/// | Braking | its brake, to a standstill| Waiting    | as above                                                  |
/// |         | (no positions, where they | Flying     | no fault for `settle`, and the autopilot was always heard |
/// |         | mean nothing)             | Ready      | no fault for `settle`, and it was not                     |
/// |         |                           | Lost       | stopped                                                   |
/// | Lost    | none: the autopilot's own | Waiting    | the pilot has left external control, or has disarmed      |
/// |         | failsafe acts             |            |                                                           |
///
/// Stopped: the brake's planned end has passed by `stop_margin`; or it has passed, the vehicle is seen to stand, and the
/// fault has lasted for `patience`.
/// Waiting becomes Ready in the same step if there is no fault: a pilot who takes over and gives back loses no time. But
/// only a switch that was seen in Ready is an order to fly: none from before a restart, from before a fault, or of a
/// link that was down.
/// An age is a fault above its limit; exactly at the limit it is not yet.
// clang-format on
enum class State : std::uint8_t { kWaiting, kReady, kFlying, kBraking, kLost };

[[nodiscard]] std::string_view toString(State state);

/// What is sent to the autopilot.
enum class Stream : std::uint8_t {
  kNone,
  kHold,      ///< stay where you are
  kMotion,    ///< the motion in force, with positions
  kVelocity,  ///< its velocities and accelerations only
};

[[nodiscard]] std::string_view toString(Stream stream);

/// What is known at one moment. Stamps are of what has been taken in, not of when.
struct Situation {
  Time now{};
  bool camera = false;
  std::optional<Time> depth;      ///< newest view of the chain
  bool depth_stuck = false;       ///< frames come, and show the same picture while the vehicle moves
  std::optional<Time> pose;       ///< newest pose of the chain
  std::optional<Time> plan;       ///< what the last decision that may be flown, of the poses' world, was planned for
  std::optional<Time> brake_end;  ///< when the motion in force stands
  std::optional<double> speed_m_s;
  bool ending = false;  ///< this process has been told to end
  bool stalled = false;
  bool anchored = false;         ///< T_NED_W is known well for the world that poses are in now
  bool motion_anchored = false;  ///< where the motion in force's world is in NED is known, now or from before

  std::optional<Time> unsent_since;  ///< what should have been sent since then was refused on its way out
  bool live_refused = false;         ///< the autopilot flies a real vehicle, and what we see is a recording
  bool linked = false;               ///< the autopilot is heard
  bool armed = false;
  bool external_control = false;
  std::uint64_t external_control_entries = 0;
};

/// What is to be done in the situation.
struct SafetyVerdict {
  State state = State::kWaiting;
  Stream stream = Stream::kNone;
  FaultSet faults;
  bool critical = false;    ///< a fault in flight has lasted for `critical_after`
  bool old_switch = false;  ///< Ready, and in external control by a switch that is no order: only another one is
};

/// The table above, driven by the situation's own time. Threads: one. Allocates: no.
class StateMachine {
 public:
  explicit StateMachine(const SafetyParameters& parameters) : parameters_(parameters) {}

  /// @param situation  of a later time than the one before
  [[nodiscard]] SafetyVerdict step(const Situation& situation);

 private:
  [[nodiscard]] FaultSet faultsOf(const Situation& situation) const;
  [[nodiscard]] bool hasStopped(const Situation& situation) const;
  void follow(const Situation& situation);
  [[nodiscard]] Stream stream(const Situation& situation) const;

  SafetyParameters parameters_;
  State state_ = State::kWaiting;
  FaultSet faults_;
  std::optional<Time> last_step_;
  std::optional<Time> last_fault_;   ///< when there was one last
  std::optional<Time> fault_since_;  ///< begin of what Braking brakes for
  std::uint64_t entries_seen_ = 0;
  bool ordered_ = false;  ///< to fly, by a switch that was seen in Ready
};

}  // namespace nanomap
