#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera_model.h"
#include "core/chain.h"
#include "core/nearest_point_index.h"
#include "drivers/lcm/body_convention.h"
#include "drivers/mavlink/alignment_estimator.h"
#include "drivers/mavlink/link_parameters.h"
#include "drivers/mavlink/obstacle_distance.h"
#include "drivers/mavlink/odometry.h"
#include "firmware_app/realtime/thread_layout.h"
#include "firmware_app/safety/feedforward.h"
#include "firmware_app/safety/safety_parameters.h"
#include "planner/planner_parameters.h"

namespace nanomap {

/// Whose clock the stamps of messages are of.
enum class ClockDomain : std::uint8_t {
  kMonotonic,  ///< this machine's CLOCK_MONOTONIC: the process's own
  kRealtime,   ///< this machine's CLOCK_REALTIME: the time of day
  kLog,        ///< a recording's: its first stamp is now
};
/// Where a recording holds the configuration that it was flown with, as nanomap.text_t: the one channel that is the
/// same everywhere, because a replay reads it before it knows the names of the others.
inline constexpr std::string_view kConfigurationChannel = "NANOMAP_CONFIG";

/// Names and habits of the LCM network, live or in a log.
struct LcmParameters {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  ClockDomain clock = ClockDomain::kMonotonic;
  std::string depth_channel = "DEPTH";
  std::string pose_channel = "POSE_BODY";
  std::string correction_channel = "POSE_CORRECTION";
  std::string camera_channel = "CAMERA";
  std::string goal_channel = "GOAL";
  std::string answers_channel = "NANOMAP_ANSWERS";
  std::string decisions_channel = "NANOMAP_DECISIONS";
  std::string steps_channel = "NANOMAP_STEPS";
  std::string setpoints_channel = "NANOMAP_SETPOINTS";
  std::string state_channel = "NANOMAP_STATE";
  std::string health_channel = "NANOMAP_HEALTH";
  std::string lost_channel = "NANOMAP_LOST";
  BodyConvention pose_t_body = BodyConvention::kFlu;  ///< of bot_core.pose_t, which does not say
  double max_body_speed_m_s = 30.0;                   ///< a faster step of the poses is a jump of their world; 0: never
};

/// The autopilot, and what it is told.
struct MavlinkParameters {
  LinkParameters link;
  AlignmentParameters alignment;
  double setpoint_rate_hz = 50.0;
  Feedforward feedforward;
  bool send_obstacles = true;  ///< OBSTACLE_DISTANCE
  ObstacleBand obstacle_band;
  bool send_odometry = false;  ///< ODOMETRY: the autopilot flies by our estimator
  OdometrySpread odometry;
};

/// How much of flights is kept, and what may wait to be written.
struct RecorderParameters {
  std::uint64_t segment_mb = 256;
  std::uint64_t total_mb = 16'384;
  std::uint64_t buffer_mb = 64;
};

/// Everything that one file configures. Plain values: the sections of the file map to them one by one
/// (firmware_app/configuration/sections.h), and their initialisers are the file's defaults.
struct Configuration {
  std::optional<CameraParameters> camera;  ///< empty: as the camera's own message says
  ChainParameters chain;                   ///< [history] and [drift]
  IndexKind index = IndexKind::kImage;     ///< in [query]
  PlannerParameters planner;               ///< [vehicle], [query] and all sections from [planner] on, up to [lcm]
  LcmParameters lcm;
  MavlinkParameters mavlink;
  SafetyParameters safety;
  Duration frame_deadline = std::chrono::milliseconds(33);  ///< in [safety]; from a frame's arrival to its plan
  RecorderParameters recorder;
  std::optional<ThreadLayout> layout;  ///< [realtime]; empty: as the machine's cores suggest
};

}  // namespace nanomap
