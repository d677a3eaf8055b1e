#pragma once

#include <atomic>
#include <cstdint>

#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/safety/commander.h"
#include "firmware_app/stages/handed_over.h"
#include "planner/receding_horizon.h"

namespace nanomap {

/// What the planner takes from and gives to. Borrowed.
struct PlanPorts {
  Mailbox<PlanningMoment>& moments;
  const std::atomic<bool>& flown;      ///< the vehicle is ours: plans go on from the motion in force
  Mailbox<PlanReport>& plans;          ///< for the sink
  SlotQueue<MadeDecision>& decisions;  ///< for the recorder
  Mailbox<MadeDecision>& newest;       ///< for the health report
};

/// Stage T4 as it runs: a plan for each moment that the chain asks for one at. The newest wins. While the vehicle is in
/// the pilot's hands, each plan starts from what is measured, so that the first one that is flown does.
/// Allocates: no, except inside FLANN. Threads: one.
class PlanStage {
 public:
  /// @throws std::invalid_argument naming the parameter that is wrong
  /// @param max_state_lead  by which the state's stamp may be ahead of our clock: more is another clock
  PlanStage(const PlannerParameters& parameters, Duration max_state_lead, const PlanPorts& ports);

  /// Plans for the moment that waits. False if none does.
  /// @param now  what is planned for, cut to whole microseconds; or the state's stamp, if that is a little later
  bool run(Time now);

  /// Arrival of the newest depth frame that was planned with.
  [[nodiscard]] Time newestFrame() const { return newest_frame_; }

 private:
  RecedingHorizon horizon_;
  Duration max_state_lead_;
  PlanPorts ports_;
  MadeDecision made_;
  std::uint64_t next_sequence_ = 0;
  std::uint64_t in_force_sequence_ = 0;
  Time newest_view_{};
  Time newest_frame_{};
};

}  // namespace nanomap
