#pragma once

#include <atomic>
#include <cstddef>

#include "firmware_app/handover/doorbell.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/pipeline/chain_stage.h"
#include "firmware_app/pipeline/step.h"
#include "firmware_app/stages/handed_over.h"
#include "firmware_app/stages/index_stage.h"
#include "firmware_app/stages/ingest.h"
#include "firmware_app/stages/sink_stage.h"

namespace nanomap {

/// Everything that one thread hands to another, made once: the arrows of the process. Each has one producer and one
/// consumer, and a bound.
struct HandOvers {
  /// @param history_views  storage for snapshots of as many views
  explicit HandOvers(std::size_t history_views) {
    for (int slot = 0; slot < 3; ++slot) {  // of a mailbox
      moments.put([&](PlanningMoment& moment) { moment.snapshot.views.reserve(history_views); });
      moments.take([](PlanningMoment&) {});
      newest.put([](ChainSnapshot& snapshot) { snapshot.views.reserve(1); });
      newest.take([](ChainSnapshot&) {});
    }
  }

  // ingest ->
  SlotQueue<ArrivedInput> inputs{512};  ///< chain: a second of poses at 400 Hz
  Mailbox<ArrivedFrame> frames;         ///< capture
  SlotQueue<ArrivedCamera> cameras{4};  ///< index
  Mailbox<IngestCounters> ingest_counters;

  // capture -> index
  SlotQueue<ArrivedFrame> captured{4};

  // index ->
  SlotQueue<IndexedFrame> indexed{16};  ///< chain
  Mailbox<IndexCounters> index_counters;
  SlotQueue<Duration> index_times{256};

  // chain ->
  SlotQueue<VehicleReport> vehicle{512};  ///< sink
  Mailbox<ChainSnapshot> newest;          ///< sink
  Mailbox<PlanningMoment> moments;        ///< planner
  SlotQueue<Step> steps{2048};            ///< recorder
  Mailbox<ChainStageCounters> chain_counters;
  SlotQueue<Duration> chain_times{1024};

  // planner ->
  Mailbox<PlanReport> plans;               ///< sink
  SlotQueue<MadeDecision> decisions{256};  ///< recorder
  Mailbox<MadeDecision> newest_decision;   ///< health
  SlotQueue<Duration> plan_times{256};

  // sink ->
  std::atomic<bool> flown{false};          ///< planner
  SlotQueue<SentSetpoint> setpoints{512};  ///< recorder
  Mailbox<SinkReport> sink_report;         ///< health
  SlotQueue<Duration> setpoint_latencies{512};

  // who was told to end -> sink
  std::atomic<bool> ending{false};

  // watchdog -> sink
  std::atomic<bool> stalled{false};

  Doorbell capture_bell;
  Doorbell index_bell;
  Doorbell chain_bell;
  Doorbell planner_bell;
};

}  // namespace nanomap
