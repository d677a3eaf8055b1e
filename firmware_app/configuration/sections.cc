#include "firmware_app/configuration/sections.h"

#include <utility>

#include "core/gaps_of_tile.h"

namespace nanomap {
namespace {

/// LCM's own limit for a channel name.
constexpr TextRule kChannelName{63};

Section vehicleSection() {
  return {"vehicle",
          "The vehicle's own size.",
          {numberKey(
               "radius_m", "Radius of the sphere around the body's origin that holds all of the vehicle.",
               {0.0, 10.0, true}, [](auto& c) -> auto& { return c.planner.risk.collision.vehicle_radius_m; }),
           numberKey(
               "bubble_margin_m",
               "Where no camera looks, next to the vehicle, absence of data is no veto: the bubble is this much\n"
               "larger than the radius.",
               {0.0, 10.0}, [](auto& c) -> auto& { return c.planner.risk.bubble_margin_m; })},
          {}};
}

Section historySection() {
  return {"history",
          "How much of the past is kept, and what joins it.",
          {integerKey(
               "views", "Depth frames kept, the oldest leaves first: 150 are 5 s at 30 Hz.", {1, 2000},
               [](auto& c) -> auto& { return c.chain.history_views; }),
           integerKey(
               "waiting_views", "Depth frames that may wait until a pose at their stamp is known.", {1, 256},
               [](auto& c) -> auto& { return c.chain.waiting_views; }),
           integerKey(
               "pose_capacity", "Poses kept: at 100 Hz, 4096 are 41 s. They must span the history.", {2, 1'000'000},
               [](auto& c) -> auto& { return c.chain.pose_capacity; }),
           durationKey(
               "max_pose_gap_s", "Widest gap between two poses that is interpolated across.", {0.0, 10.0, true},
               [](auto& c) -> auto& { return c.chain.max_pose_gap; }),
           durationKey(
               "max_lead_s", "A depth frame farther ahead of the newest pose is dropped: its clock is another one.",
               {0.0, 60.0}, [](auto& c) -> auto& { return c.chain.max_lead; })},
          {}};
}

Section driftSection() {
  return {"drift",
          "How far the estimated position drifts: the standard deviation of relative position after a time.",
          {numberKey(
               "horizontal_std_m", "Along each horizontal axis, after after_s.", {0.0, 100.0},
               [](auto& c) -> auto& { return c.chain.drift.horizontal_std_m; }),
           numberKey(
               "vertical_std_m", "Along the vertical, after after_s.", {0.0, 100.0},
               [](auto& c) -> auto& { return c.chain.drift.vertical_std_m; }),
           durationKey(
               "after_s", "The time that the two above refer to.", {0.0, 3600.0, true},
               [](auto& c) -> auto& { return c.chain.drift.after; }),
           choiceKey<GrowthLaw>(
               "law",
               "How the standard deviation grows with time: square_root if successive errors are\n"
               "independent, linear if they are alike (a wrong velocity).",
               {{"square_root", GrowthLaw::kSquareRoot}, {"linear", GrowthLaw::kLinear}},
               [](auto& c) -> auto& { return c.chain.drift.law; }),
           booleanKey(
               "use_increments", "Take increment covariances from the pose messages instead, where they carry them.",
               [](auto& c) -> auto& { return c.chain.drift.use_increments; })},
          {}};
}

Section querySection() {
  return {
      "query",
      "How the history is asked for the nearest obstacles.",
      {choiceKey<IndexKind>(
           "index",
           "What finds the nearest points of a depth frame: image, which knows them to be an image, or FLANN's\n"
           "k-d tree. Distances are the same, to the last bit; flann is slower by far.",
           {{"image", IndexKind::kImage}, {"flann", IndexKind::kFlann}}, [](auto& c) -> auto& { return c.index; }),
       integerKey(
           "k", "Nearest measured points reported with each answer.", {1, kMaxNeighbours},
           [](auto& c) -> auto& { return c.planner.risk.query.k; }),
       choiceKey<OcclusionTest>(
           "occlusion",
           "What must lie in front of the measured depth for a point to be free: its mean, or\n"
           "the whole footprint of its 1-sigma box in the image.",
           {{"mean", OcclusionTest::kMean}, {"footprint", OcclusionTest::kFootprint}},
           [](auto& c) -> auto& { return c.planner.risk.query.occlusion; }),
       integerKey(
           "open_window_px",
           "A pixel without depth is sky, not a hole, if nothing near is seen within this many pixels\n"
           "around it.",
           {0, 1024}, [](auto& c) -> auto& { return c.planner.risk.query.open_window_px; }),
       numberKey(
           "open_range_fraction", "\"Near\", there, is up to this part of the camera's range.", {0.0, 1.0},
           [](auto& c) -> auto& { return c.planner.risk.query.open_range_fraction; }),
       numberKey(
           "open_frame_m",
           "Nor is it sky, for a point, if within this distance beside the point something is seen that is no more\n"
           "than this farther away: the frame of a pane that fills the view.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.planner.risk.query.open_frame_m; }),
       integerKey(
           "narrow_gap_px",
           "For risk.demand_certificate: a gap among the depths that is at most this wide, in pixels, hides nothing.",
           {0, GapsOfTile::kWidest_px}, [](auto& c) -> auto& { return c.planner.risk.query.narrow_gap_px; }),
       numberKey(
           "certify_sigmas",
           "Of views that may certify a place, the best is the one with the largest radius less this many standard\n"
           "deviations of the drift since then.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.planner.risk.query.certify_sigmas; })},
      {}};
}

Section lcmSection() {
  return {
      "lcm",
      "Names and habits of the LCM network, live or in a log.",
      {textKey(
           "url", "The network. ttl=0 keeps messages on this machine: anyone who can send to it can send poses.",
           TextRule{255}, [](auto& c) -> auto& { return c.lcm.url; }),
       choiceKey<ClockDomain>(
           "clock",
           "Whose clock the stamps of all messages are of: monotonic (CLOCK_MONOTONIC of this machine), realtime (its\n"
           "time of day), or log: a recording that is played back, whose first stamp is now. A log is never flown.",
           {{"monotonic", ClockDomain::kMonotonic}, {"realtime", ClockDomain::kRealtime}, {"log", ClockDomain::kLog}},
           [](auto& c) -> auto& { return c.lcm.clock; }),
       textKey(
           "depth_channel", "Depth: nanomap.depth_image_t, bot_core.images_t or bot_core.image_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.depth_channel; }),
       textKey(
           "pose_channel", "Poses: nanomap.body_pose_t or bot_core.pose_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.pose_channel; }),
       textKey(
           "correction_channel", "Corrections: nanomap.pose_correction_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.correction_channel; }),
       textKey(
           "camera_channel", "The camera: nanomap.camera_model_t. Not read if [camera] is in this file.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.camera_channel; }),
       textKey(
           "goal_channel", "Goals: nanomap.goal_t.", kChannelName, [](auto& c) -> auto& { return c.lcm.goal_channel; }),
       textKey(
           "answers_channel", "Answers, as a replay writes them: nanomap.answers_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.answers_channel; }),
       textKey(
           "decisions_channel", "What the planner decided: nanomap.decision_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.decisions_channel; }),
       textKey(
           "steps_channel", "What the chain took in, in which order, as a recording holds it: nanomap.step_t.",
           kChannelName, [](auto& c) -> auto& { return c.lcm.steps_channel; }),
       textKey(
           "setpoints_channel", "What the autopilot was told: nanomap.setpoint_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.setpoints_channel; }),
       textKey(
           "state_channel", "Changes of the flight process's state, in words: nanomap.text_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.state_channel; }),
       textKey(
           "health_channel", "How the flight process is, once a second: nanomap.health_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.health_channel; }),
       textKey(
           "lost_channel", "What a recording lacks: nanomap.lost_t.", kChannelName,
           [](auto& c) -> auto& { return c.lcm.lost_channel; }),
       choiceKey<BodyConvention>(
           "pose_t_body",
           "Body axes of bot_core.pose_t, which does not say: flu (forward, left, up) or frd\n"
           "(forward, right, down).",
           {{"flu", BodyConvention::kFlu}, {"frd", BodyConvention::kFrd}},
           [](auto& c) -> auto& { return c.lcm.pose_t_body; }),
       numberKey(
           "max_body_speed_m_s",
           "A faster step from pose to pose is a jump of the estimator's world that it did not tell (bot_core.pose_t\n"
           "cannot; nanomap.body_pose_t has an epoch): nothing is subtracted across it. 0 switches this off.",
           {0.0, 1000.0}, [](auto& c) -> auto& { return c.lcm.max_body_speed_m_s; })},
      {}};
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> ordered = {cameraSection(), vehicleSection(), historySection(), driftSection(),
                                    querySection()};
    for (Section& section : plannerSections()) ordered.push_back(std::move(section));
    ordered.push_back(lcmSection());
    for (Section& section : flightSections()) ordered.push_back(std::move(section));
    ordered.push_back(realtimeSection());
    return ordered;
  }();
  return all;
}

std::string qualifiedName(const Section& section, const Key& key) { return section.name + "." + key.name; }

std::optional<QualifiedKey> findKey(std::string_view qualified_name) {
  for (const Section& section : sections()) {
    for (const Key& key : section.keys) {
      if (qualifiedName(section, key) == qualified_name) return QualifiedKey{&section, &key};
    }
  }
  return std::nullopt;
}

}  // namespace nanomap
