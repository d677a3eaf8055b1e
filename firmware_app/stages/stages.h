#pragma once

#include "core/time.h"
#include "drivers/mavlink/autopilot_link.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/stages/chain_keeper.h"
#include "firmware_app/stages/depth_source.h"
#include "firmware_app/stages/hand_overs.h"
#include "firmware_app/stages/index_stage.h"
#include "firmware_app/stages/ingest.h"
#include "firmware_app/stages/plan_stage.h"
#include "firmware_app/stages/sink_stage.h"

namespace nanomap {

/// The whole way from messages to setpoints: every stage, and what they hand to each other. Who runs them, on one
/// thread or on six, is someone else's business (flight_process.h).
struct Stages {
  /// Borrows the link.
  /// @param realtime_ahead  the realtime clock minus the monotonic one, now
  /// @throws std::invalid_argument naming the parameter that is wrong
  Stages(const Configuration& configuration, Duration realtime_ahead, AutopilotLink& link);

  /// Stage T1: waits for a frame at most this long, and hands it to the index.
  void capture(Duration at_most);

  HandOvers hand_overs;
  Ingest ingest;
  IndexStage index;
  ChainKeeper chain;
  PlanStage plan;
  SinkStage sink;

 private:
  MessageDepthSource depth_source_;
  ArrivedFrame captured_;
};

}  // namespace nanomap
