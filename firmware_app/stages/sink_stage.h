#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/autopilot_link.h"
#include "drivers/mavlink/odometry.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/safety/commander.h"
#include "firmware_app/safety/pilot_voice.h"
#include "firmware_app/stages/handed_over.h"

namespace nanomap {

struct SinkParameters {
  SafetyParameters safety{};
  MotionLimits limits{};
  AlignmentParameters alignment{};
  double max_yaw_rate_rad_s = 1.0;
  Feedforward feedforward{};
  bool send_obstacles = true;  ///< OBSTACLE_DISTANCE, at 10 Hz
  ObstacleBand obstacle_band{};
  QueryOptions query{};        ///< by which obstacles are judged
  bool recording = false;      ///< what we see is one: a live autopilot is told nothing
  bool send_odometry = false;  ///< ODOMETRY, at every pose up to 50 Hz: the autopilot flies by our estimator
  OdometrySpread odometry{};
};

/// What was sent to the autopilot at one moment, and why.
struct SentSetpoint {
  Time stamp{};
  SafetyVerdict verdict;
  std::optional<CommandedMotion> motion;  ///< empty: nothing was sent
};

struct SinkCounters {
  std::uint64_t setpoints = 0;  ///< handed to the link
  std::uint64_t setpoints_failed = 0;
  std::uint64_t plans_refused = 0;  ///< whose motion cannot be flown
  std::uint64_t texts = 0;
  AlignmentCounters alignment;
};

/// What the sink stage knows, for the health report.
struct SinkReport {
  SafetyVerdict verdict;
  Alignment alignment;
  AutopilotState autopilot;
  Reason reason = Reason::kNoView;
  std::optional<Duration> depth_age;
  std::optional<Duration> pose_age;
  std::optional<Duration> plan_age;
  SinkCounters counters;
};

/// What the sink stage takes from and gives to. Borrowed.
struct SinkPorts {
  SlotQueue<VehicleReport>& vehicle;
  Mailbox<PlanReport>& plans;
  Mailbox<ChainSnapshot>& newest;
  std::atomic<bool>& flown;            ///< set: the vehicle is ours
  const std::atomic<bool>& ending;     ///< this process has been told to end
  const std::atomic<bool>& stalled;    ///< a thread of this process does not answer
  SlotQueue<SentSetpoint>& setpoints;  ///< for the recorder
  Mailbox<SinkReport>& report;
  SlotQueue<Duration>& latencies;  ///< from a frame's exposure to the first setpoint of a plan that knows it
};

/// The last stage as it runs: what is known of vehicle, plan and autopilot to what the autopilot is told. The only one
/// that sends setpoints, each sampled for the moment that it is sent at.
/// Threads: one, of no real-time scheduling: sending allocates and may wait for a lock.
class SinkStage {
 public:
  /// Borrows the link.
  /// @throws std::invalid_argument naming the parameter that is wrong
  SinkStage(const SinkParameters& parameters, AutopilotLink& link, const SinkPorts& ports);

  /// One round; to be called at 50 Hz or faster.
  void run(Time now);

 private:
  /// @return is there another plan?
  bool takeIn(Time now);
  void send(Time now, const Command& command);
  void sendOdometry(const VehicleState& state);
  void sendObstacles(Time now);

  SinkParameters parameters_;
  AutopilotLink& link_;
  SinkPorts ports_;
  AlignmentEstimator alignment_;
  Commander commander_;
  PilotVoice voice_;
  CommandInputs inputs_;
  SystemStatus status_ = SystemStatus::kBoot;
  std::optional<Time> odometry_sent_;
  std::optional<Time> obstacles_sent_;
  SinkCounters counters_;
};

}  // namespace nanomap
