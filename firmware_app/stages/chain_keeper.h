#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware_app/handover/doorbell.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/pipeline/chain_stage.h"
#include "firmware_app/pipeline/step.h"
#include "firmware_app/safety/commander.h"
#include "firmware_app/stages/handed_over.h"

namespace nanomap {

/// What the chain takes from and gives to. Borrowed.
struct ChainPorts {
  SlotQueue<ArrivedInput>& inputs;
  SlotQueue<IndexedFrame>& indexed;
  SlotQueue<VehicleReport>& vehicle;  ///< one for each pose, for the sink
  Mailbox<ChainSnapshot>& newest;     ///< with the newest view only, for what the autopilot is told of obstacles
  Mailbox<PlanningMoment>& moments;   ///< for the planner,
  Doorbell& planner_bell;             ///< which is rung
  SlotQueue<Step>& steps;             ///< for the recorder
  Mailbox<ChainStageCounters>& counters;
};

/// Stage T3 as it runs: the one place where everything is consumed, in an order that is told step by step. A plan is
/// asked for whenever a view has entered the chain.
/// Allocates: as the chain does. Threads: one.
class ChainKeeper {
 public:
  /// @throws std::invalid_argument naming the parameter that is wrong
  ChainKeeper(const ChainParameters& parameters, const StuckDepthParameters& stuck_depth, bool camera_known,
              const ChainPorts& ports);

  /// Takes all that waits; how many things there were.
  /// @param now  that the steps are stamped with
  std::size_t run(Time now);

  /// Arrival of the newest depth frame taken; empty before the first.
  [[nodiscard]] std::optional<Time> newestFrame() const { return newest_frame_; }

 private:
  void take(const ArrivedInput& arrived, Time now);
  void take(IndexedFrame& arrived, Time now);
  void noteStep(InputKind kind, Time arrival, Duration stamp_shift, Time now);
  void report();
  void askForAPlan();

  ChainStage stage_;
  ChainPorts ports_;
  std::uint64_t steps_ = 0;
  std::optional<Time> newest_frame_;
  std::size_t views_entered_ = 0;  ///< since a plan was asked for
  bool camera_known_;
};

}  // namespace nanomap
