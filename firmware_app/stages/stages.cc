#include "firmware_app/stages/stages.h"

#include <utility>

namespace nanomap {
namespace {

/// Views that are on their way, or held by a snapshot that nobody has replaced yet.
constexpr std::size_t kViewsUnderWay = 32;

SinkParameters sinkParameters(const Configuration& configuration) {
  SinkParameters sink;
  sink.safety = configuration.safety;
  sink.limits = configuration.planner.limits;
  sink.alignment = configuration.mavlink.alignment;
  sink.max_yaw_rate_rad_s = configuration.planner.heading.max_rate_rad_s;
  sink.feedforward = configuration.mavlink.feedforward;
  sink.send_obstacles = configuration.mavlink.send_obstacles;
  sink.obstacle_band = configuration.mavlink.obstacle_band;
  sink.query = configuration.planner.risk.query;
  sink.recording = configuration.lcm.clock == ClockDomain::kLog;
  sink.send_odometry = configuration.mavlink.send_odometry;
  sink.odometry = configuration.mavlink.odometry;
  return sink;
}

ViewBuilder viewBuilder(const Configuration& configuration) {
  const ChainParameters& chain = configuration.chain;
  return ViewBuilder(configuration.camera, configuration.index,
                     chain.history_views + chain.waiting_views + kViewsUnderWay);
}

}  // namespace

Stages::Stages(const Configuration& configuration, Duration realtime_ahead, AutopilotLink& link)
    : hand_overs(configuration.chain.history_views),
      ingest(configuration.lcm,
             StampClock(configuration.lcm.clock, configuration.safety.max_stamp_lead, realtime_ahead),
             {hand_overs.inputs, hand_overs.chain_bell, hand_overs.frames, hand_overs.capture_bell, hand_overs.cameras,
              hand_overs.index_bell, hand_overs.ingest_counters}),
      index(viewBuilder(configuration), {hand_overs.cameras, hand_overs.captured, hand_overs.indexed,
                                         hand_overs.chain_bell, hand_overs.index_counters}),
      chain(configuration.chain, configuration.safety.stuck_depth, configuration.camera.has_value(),
            {hand_overs.inputs, hand_overs.indexed, hand_overs.vehicle, hand_overs.newest, hand_overs.moments,
             hand_overs.planner_bell, hand_overs.steps, hand_overs.chain_counters}),
      plan(configuration.planner, configuration.safety.max_stamp_lead,
           {hand_overs.moments, hand_overs.flown, hand_overs.plans, hand_overs.decisions, hand_overs.newest_decision}),
      sink(sinkParameters(configuration), link,
           {hand_overs.vehicle, hand_overs.plans, hand_overs.newest, hand_overs.flown, hand_overs.ending,
            hand_overs.stalled, hand_overs.setpoints, hand_overs.sink_report, hand_overs.setpoint_latencies}),
      depth_source_(hand_overs.frames, hand_overs.capture_bell) {}

void Stages::capture(Duration at_most) {
  if (!depth_source_.capture(captured_, at_most)) return;
  hand_overs.captured.push([this](ArrivedFrame& slot) { std::swap(slot, captured_); });
  hand_overs.index_bell.ring();
}

}  // namespace nanomap
