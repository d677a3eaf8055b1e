#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

constexpr NumberRule kDuration_s{0.0, 60.0, true};

Section mavlinkSection() {
  return {
      "mavlink",
      "The autopilot, and what it is told.",
      {textKey(
           "url", "udpin://0.0.0.0:14540, udpout://host:port, tcpout://host:port or serial:///dev/ttyACM0:921600.",
           TextRule{255}, [](auto& c) -> auto& { return c.mavlink.link.url; }),
       integerKey(
           "system_id",
           "The vehicle's: a companion computer is a part of it. Another vehicle's autopilot gets no setpoint.",
           {1, 255}, [](auto& c) -> auto& { return c.mavlink.link.system_id; }),
       integerKey(
           "component_id", "Ours; 196 is MAV_COMP_ID_OBSTACLE_AVOIDANCE.", {1, 255},
           [](auto& c) -> auto& { return c.mavlink.link.component_id; }),
       durationKey(
           "heartbeat_timeout_s", "The autopilot is gone if it was not heard for longer.", kDuration_s,
           [](auto& c) -> auto& { return c.mavlink.link.heartbeat_timeout; }),
       numberKey(
           "pose_rate_hz", "How often the autopilot is asked to tell its position and attitude.", {1.0, 400.0},
           [](auto& c) -> auto& { return c.mavlink.link.pose_rate_hz; }),
       numberKey(
           "setpoint_rate_hz", "How often it is told where to fly.", {20.0, 400.0},
           [](auto& c) -> auto& { return c.mavlink.setpoint_rate_hz; }),
       durationKey(
           "setpoint_lead_s",
           "A setpoint is the motion's place so much later than it is sent: half a period until the next one, the way\n"
           "there and half the autopilot's own period, or the vehicle is that time behind.",
           {0.0, 0.2}, [](auto& c) -> auto& { return c.mavlink.feedforward.setpoint_lead; }),
       durationKey(
           "tilt_lag_s",
           "The acceleration told is that of so much later still, as the vehicle has to tilt before it accelerates:\n"
           "the time constant of its attitude. Too little leaves it behind, too much ahead. Set drag_1_s as well: the\n"
           "lag told without the drag may be worse than neither.",
           {0.0, 0.5}, [](auto& c) -> auto& { return c.mavlink.feedforward.tilt_lag; }),
       numberKey(
           "drag_1_s",
           "And this times the velocity is added [1/s], for the drag of the air, which autopilots do not know: 9.81\n"
           "times the tilt [rad] that holds a steady speed in still air, divided by that speed [m/s]. Rather too\n"
           "little than too much: with half of it the vehicle follows better, with thrice much worse than without.",
           {0.0, 1.0}, [](auto& c) -> auto& { return c.mavlink.feedforward.drag_1_s; }),
       booleanKey(
           "send_obstacles", "Send OBSTACLE_DISTANCE: the nearest obstacles of the newest depth frame, by bearing.",
           [](auto& c) -> auto& { return c.mavlink.send_obstacles; }),
       numberKey(
           "obstacles_below_m", "For that, an obstacle is what is no more than this below the body,", {0.0, 100.0},
           [](auto& c) -> auto& { return c.mavlink.obstacle_band.below_m; }),
       numberKey(
           "obstacles_above_m", "and no more than this above it.", {0.0, 100.0},
           [](auto& c) -> auto& { return c.mavlink.obstacle_band.above_m; }),
       booleanKey(
           "send_odometry",
           "Send ODOMETRY: the autopilot flies by the poses that we get. PX4: EKF2_EV_CTRL; ArduPilot: EK3_SRC1_*,\n"
           "VISO_TYPE.",
           [](auto& c) -> auto& { return c.mavlink.send_odometry; }),
       numberKey(
           "odometry_position_sd_m",
           "How wrong those poses are, which do not say so themselves: the standard deviation on each axis; 0 tells "
           "the\n"
           "autopilot that nobody knows.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.mavlink.odometry.position_sd_m; }),
       numberKey(
           "odometry_attitude_sd_rad", "The same about each axis. Both or neither.", {0.0, 3.2},
           [](auto& c) -> auto& { return c.mavlink.odometry.attitude_sd_rad; }),
       numberKey(
           "odometry_velocity_sd_m_s", "The same of the velocity; 0: nobody knows.", {0.0, 100.0},
           [](auto& c) -> auto& { return c.mavlink.odometry.velocity_sd_m_s; })},
      {}};
}

Section alignmentSection() {
  return {"alignment",
          "Where the estimator's world is in the autopilot's, from both pose streams. Without it nothing is flown.",
          {durationKey(
               "window_s", "Of the poses that are compared: for the heading, and whether they fit.", kDuration_s,
               [](auto& c) -> auto& { return c.mavlink.alignment.window; }),
           durationKey(
               "place_window_s", "Of those that tell the place, which drifts; not above window_s.", kDuration_s,
               [](auto& c) -> auto& { return c.mavlink.alignment.place_window; }),
           integerKey(
               "min_pairs", "Fewer pairs of poses, one each 50 ms, say nothing.", {3, 1000},
               [](auto& c) -> auto& { return c.mavlink.alignment.min_pairs; }),
           durationKey(
               "max_age_s",
               "Of the newest pair: what the autopilot says may be missing for so long. At least four intervals of\n"
               "mavlink.pose_rate_hz.",
               kDuration_s, [](auto& c) -> auto& { return c.mavlink.alignment.max_age; }),
           numberKey(
               "max_position_residual_m", "The two streams fit each other up to this, in the median over the window,",
               {0.0, 100.0, true}, [](auto& c) -> auto& { return c.mavlink.alignment.max_position_residual_m; }),
           numberKey(
               "max_heading_residual_rad", "and this.", {0.0, 3.2, true},
               [](auto& c) -> auto& { return c.mavlink.alignment.max_heading_residual_rad; }),
           numberKey(
               "jump_m", "A pair that is off by more has jumped, if those after it have too.", {0.0, 100.0, true},
               [](auto& c) -> auto& { return c.mavlink.alignment.jump_m; }),
           numberKey(
               "jump_rad", "The same for the heading.", {0.0, 3.2, true},
               [](auto& c) -> auto& { return c.mavlink.alignment.jump_rad; }),
           numberKey(
               "follow_m_s", "How fast setpoints may be shifted as it is known better.", {0.0, 10.0, true},
               [](auto& c) -> auto& { return c.mavlink.alignment.follow_m_s; }),
           numberKey(
               "follow_rad_s", "How fast they may be turned.", {0.0, 3.2, true},
               [](auto& c) -> auto& { return c.mavlink.alignment.follow_rad_s; })},
          {}};
}

Section safetySection() {
  return {
      "safety",
      "When what is known is too old to fly on. Then the brake that was verified with the last good plan is flown, "
      "and\n"
      "after it nothing is sent any more, so that the autopilot's own failsafe acts.",
      {durationKey(
           "max_plan_age_s",
           "Of the plan that is flown. planner.brake_after_s must cover it, and mavlink.setpoint_lead_s and "
           "tilt_lag_s.",
           kDuration_s, [](auto& c) -> auto& { return c.safety.max_plan_age; }),
       durationKey(
           "max_depth_age_s", "Of the newest depth frame, from its exposure.", kDuration_s,
           [](auto& c) -> auto& { return c.safety.max_depth_age; }),
       durationKey(
           "max_pose_age_s", "Of the newest pose.", kDuration_s,
           [](auto& c) -> auto& { return c.safety.max_pose_age; }),
       durationKey(
           "max_stamp_lead_s", "Stamps farther ahead of our clock are of another clock.", kDuration_s,
           [](auto& c) -> auto& { return c.safety.max_stamp_lead; }),
       durationKey(
           "max_step_s",
           "This process was held up if it did not send for longer, or what it sent was refused for longer.",
           kDuration_s, [](auto& c) -> auto& { return c.safety.max_step; }),
       durationKey(
           "critical_after_s", "A fault in flight that has lasted for this is critical.", kDuration_s,
           [](auto& c) -> auto& { return c.safety.critical_after; }),
       durationKey(
           "settle_s", "So long without a fault, and it counts as over.", kDuration_s,
           [](auto& c) -> auto& { return c.safety.settle; }),
       durationKey(
           "patience_s",
           "A vehicle that stands is let go when a fault has lasted for this; not below\n"
           "critical_after_s.",
           kDuration_s, [](auto& c) -> auto& { return c.safety.patience; }),
       durationKey(
           "stop_margin_s", "This long after a brake should have ended, the vehicle is let go in any case.",
           kDuration_s, [](auto& c) -> auto& { return c.safety.stop_margin; }),
       numberKey(
           "standstill_m_s", "A slower vehicle stands.", {0.0, 10.0, true},
           [](auto& c) -> auto& { return c.safety.standstill_m_s; }),
       integerKey(
           "stuck_depth_images",
           "The camera is stuck if so many depth frames after one are the same to the last count,", {0, 1000},
           [](auto& c) -> auto& { return c.safety.stuck_depth.images; }),
       numberKey(
           "stuck_depth_motion_m",
           "and the poses have moved this far meanwhile: a frame without noise is no fault of a vehicle that stands.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.safety.stuck_depth.motion_m; }),
       numberKey(
           "stuck_depth_turn_rad", "Or have turned by this. stuck_depth_images = 0 switches this off.", {0.0, 3.2},
           [](auto& c) -> auto& { return c.safety.stuck_depth.turn_rad; }),
       durationKey(
           "frame_deadline_s",
           "A depth frame that has not been indexed, put into the chain and planned with within this time of its\n"
           "arrival is late; health counts these, by stage.",
           kDuration_s, [](auto& c) -> auto& { return c.frame_deadline; })},
      {}};
}

Section recorderSection() {
  return {"recorder",
          "Recordings of flights: files of bounded size in one folder (nanomap-flight --record).",
          {integerKey(
               "segment_mb", "Largest size of a file, each of which can be read alone.", {1, 4096},
               [](auto& c) -> auto& { return c.recorder.segment_mb; }),
           integerKey(
               "total_mb",
               "Largest size of all of them, those of earlier flights included: the oldest are deleted. 320x240 raw\n"
               "depth at 30 Hz takes 17000 an hour. At least twice segment_mb.",
               {2, 16'777'216}, [](auto& c) -> auto& { return c.recorder.total_mb; }),
           integerKey(
               "buffer_mb", "Of messages that may wait while the disk is slow; what does not fit is lost and counted.",
               {1, 4096}, [](auto& c) -> auto& { return c.recorder.buffer_mb; })},
          {}};
}

}  // namespace

std::vector<Section> flightSections() {
  return {mavlinkSection(), alignmentSection(), safetySection(), recorderSection()};
}

}  // namespace nanomap
