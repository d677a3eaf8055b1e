#include <algorithm>
#include <numbers>
#include <string>

#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

constexpr NumberRule kProbability{0.0, 1.0};
constexpr NumberRule kAcceleration{0.0, 100.0, true};
constexpr NumberRule kAltitude{-10'000.0, 10'000.0};
constexpr NumberRule kWeight{0.0, 1e6};
constexpr NumberRule kDeviation{0.0, 100.0};

Section planningSection() {
  return {
      "planner",
      "How a plan is made: candidates are judged by risk first, then by the objective. Ranges that depend on other\n"
      "keys are checked when all of the file is read.",
      {choiceKey<StopCheck>(
           "stop_check",
           "What a candidate must show beyond a safe motion. verified: a brake that is as safe and ends in space\n"
           "seen as free. paper: nothing, as in the paper, for experiments; such a plan carries no brake to fly.",
           {{"verified", StopCheck::kVerified}, {"paper", StopCheck::kPaper}},
           [](auto& c) -> auto& { return c.planner.stop_check; }),
       numberKey(
           "brake_after_s",
           "When the brake that is verified with a motion leaves it: above the plan period plus the age at which a\n"
           "plan is stale, and not above horizon.push_s and horizon.min_s.",
           {0.0, 10.0, true}, [](auto& c) -> auto& { return c.planner.brake_after_s; }),
       integerKey(
           "samples",
           "Steps that a motion is judged in, at least: even ones along each fifth of its time, none longer than the\n"
           "vehicle's radius.",
           {1, 1000}, [](auto& c) -> auto& { return c.planner.samples; }),
       integerKey(
           "brake_samples", "The same for a brake.", {1, 1000},
           [](auto& c) -> auto& { return c.planner.brake_samples; }),
       booleanKey(
           "early_exit", "Skip candidates that cannot win any more. The choice is the same without, and takes longer.",
           [](auto& c) -> auto& { return c.planner.early_exit; }),
       durationKey(
           "max_state_age_s", "An older state of the vehicle is not planned from.", {0.0, 10.0, true},
           [](auto& c) -> auto& { return c.planner.max_state_age; })},
      {}};
}

Section limitsSection() {
  return {
      "limits",
      "How hard the vehicle may be pushed.",
      {numberKey(
           "horizontal_at_rest_m_s2", "Largest horizontal acceleration of a motion that starts at rest.", kAcceleration,
           [](auto& c) -> auto& { return c.planner.limits.horizontal_at_rest_m_s2; }),
       numberKey(
           "horizontal_at_full_m_s2",
           "The same from full_speed_m_s on, linear in between; not below the one at rest. A brake may use it at any\n"
           "speed.",
           kAcceleration, [](auto& c) -> auto& { return c.planner.limits.horizontal_at_full_m_s2; }),
       numberKey(
           "full_speed_m_s", "Speed from which on the vehicle may be pushed hardest.", {0.0, 100.0, true},
           [](auto& c) -> auto& { return c.planner.limits.full_speed_m_s; }),
       numberKey(
           "top_speed_m_s", "No goal is flown faster, whatever top speed it comes with.", {0.0, 100.0, true},
           [](auto& c) -> auto& { return c.planner.limits.top_speed_m_s; }),
       numberKey(
           "vertical_m_s2", "Largest vertical acceleration.", kAcceleration,
           [](auto& c) -> auto& { return c.planner.limits.vertical_m_s2; }),
       numberKey(
           "ramp_s", "Time from one acceleration to another, unless the jerk limit asks for more.", {0.0, 10.0, true},
           [](auto& c) -> auto& { return c.planner.limits.ramp_s; }),
       numberKey(
           "jerk_m_s3", "Largest jerk.", {0.0, 10'000.0, true},
           [](auto& c) -> auto& { return c.planner.limits.jerk_m_s3; })},
      {}};
}

Section horizonSection() {
  return {
      "horizon",
      "How far ahead a motion must be safe: the time that distance_m takes at the present speed, within limits.",
      {numberKey(
           "push_s",
           "How long a motion's acceleration is held, before it goes straight on; not below planner.brake_after_s.",
           {0.0, 60.0, true}, [](auto& c) -> auto& { return c.planner.horizon.push_s; }),
       numberKey(
           "min_s",
           "At least. What lies beyond the camera's range is not safe: a vehicle that flies so far in this time slows.",
           {0.0, 60.0, true}, [](auto& c) -> auto& { return c.planner.horizon.min_s; }),
       numberKey(
           "max_s", "At most; not below min_s.", {0.0, 60.0, true},
           [](auto& c) -> auto& { return c.planner.horizon.max_s; }),
       numberKey(
           "distance_m", "To be flown in it: a slow vehicle looks longer ahead than min_s.", {0.0, 1000.0, true},
           [](auto& c) -> auto& { return c.planner.horizon.distance_m; })},
      {}};
}

Section goalDirectedSection() {
  return {"goal_directed",
          "The one candidate that heads straight for the goal.",
          {numberKey(
               "approach_s", "Wanted speed: the distance to the goal in this time, up to the goal's top speed.",
               {0.0, 60.0, true}, [](auto& c) -> auto& { return c.planner.goal_directed.approach_s; }),
           numberKey(
               "response_s", "Time in which the velocity would reach the wanted one.", {0.0, 60.0, true},
               [](auto& c) -> auto& { return c.planner.goal_directed.response_s; })},
          {}};
}

Section objectiveSection() {
  return {
      "objective",
      "What a candidate is worth; one unit is a metre nearer to the goal.",
      {numberKey(
           "speed_weight_s2_m2", "Cost, times the square of the speed above the goal's top speed.", kWeight,
           [](auto& c) -> auto& { return c.planner.objective.speed_weight_s2_m2; }),
       numberKey(
           "altitude_weight_1_m2", "Cost, times the square of the height above or below the goal.", kWeight,
           [](auto& c) -> auto& { return c.planner.objective.altitude_weight_1_m2; }),
       numberKey(
           "min_altitude_W_m", "Lower end of the band to stay in, in the estimator's world.", kAltitude,
           [](auto& c) -> auto& { return c.planner.objective.min_altitude_W_m; }),
       numberKey(
           "max_altitude_W_m", "Its upper end; not below the lower one.", kAltitude,
           [](auto& c) -> auto& { return c.planner.objective.max_altitude_W_m; }),
       numberKey(
           "out_of_band_cost", "Cost of leaving the band.", kWeight,
           [](auto& c) -> auto& { return c.planner.objective.out_of_band_cost; }),
       numberKey(
           "collision_reward", "Worth of a collision: at -1000, a probability of 0.001 costs about a metre.",
           {-1e9, 1e9}, [](auto& c) -> auto& { return c.planner.objective.collision_reward; }),
       numberKey(
           "goal_tolerance_m", "A standstill this near is at the goal.", {0.0, 100.0, true},
           [](auto& c) -> auto& { return c.planner.objective.goal_tolerance_m; }),
       numberKey(
           "least_gain_m", "Flying on must be worth this much more than stopping; below what one plan gains from rest.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.planner.objective.least_gain_m; })},
      {}};
}

/// "prior_beyond_range"
std::string priorName(Status status) {
  std::string name = "prior_" + std::string(toString(status));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string_view priorHelp(Status status) {
  switch (status) {
    case Status::kFree:
      return "Collision probability, before any obstacle counts, of a place in front of what was seen.";
    case Status::kPartial:
      return "The same where only part of what the place may be is in view.";
    case Status::kOpen:
      return "The same of sky: no depth, and nothing near around it.";
    case Status::kHole:
      return "The same where the image has no depth otherwise: glass, texture, too near.";
    case Status::kOccluded:
      return "The same behind what was seen.";
    case Status::kBeyondRange:
      return "The same farther away than the camera is trusted.";
    case Status::kOutsideFov:
      return "The same beside every view.";
    case Status::kBehind:
      return "The same behind the camera.";
    case Status::kEmpty:
      return "The same without any view.";
  }
  return "?";
}

Section riskSection() {
  Section section{
      "risk",
      "How the chance of a collision is computed and bounded. The vehicle's size is in [vehicle], what is asked of "
      "the\n"
      "history in [query].",
      {numberKey(
           "max_risk", "The chance constraint: largest collision probability of a whole motion, and of its brake.",
           kProbability, [](auto& c) -> auto& { return c.planner.risk.max_risk; }),
       choiceKey<CollisionModel>(
           "collision_model",
           "ball: the chance of an error as large as the nearest obstacle's distance, never below the truth.\n"
           "gaussian_volume: the approximation of the WAFR 2016 planner, for experiments: no bound.\n"
           "half_spaces: one half space for each of query.k neighbours; what is not among them does not count.",
           {{"ball", CollisionModel::kBall},
            {"gaussian_volume", CollisionModel::kGaussianVolume},
            {"half_spaces", CollisionModel::kHalfSpaces}},
           [](auto& c) -> auto& { return c.planner.risk.collision.model; }),
       booleanKey(
           "look_beside",
           "Where the view that answers holds less than the vehicle around a place, also ask the newest view that\n"
           "holds all of it: a ledge just above a view's upper edge is not in it. And where newer views could not\n"
           "answer, also ask the newest that holds the place: before a gap in its depths there may be a branch that\n"
           "only it has seen. false: the answering view alone, as in the paper.",
           [](auto& c) -> auto& { return c.planner.risk.look_beside; }),
       numberKey(
           "beside_beyond_m",
           "With look_beside: farther from the vehicle than this, a place that is in view, but that no view has room\n"
           "around, counts as taken. Nobody knows what is beside it.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.planner.risk.beside_beyond_m; }),
       booleanKey(
           "demand_certificate",
           "Space around a place that no view has seen empty counts as an obstacle: what is hidden or lies outside "
           "the\n"
           "view that answers cannot be hit unseen. Safer, slower, takes more time to plan; narrow passages stay "
           "closed.",
           [](auto& c) -> auto& { return c.planner.risk.demand_certificate; }),
       numberKey(
           "certificate_beyond_m",
           "Not of places nearer to the vehicle than this, beside which a camera that stands still never looks.",
           {0.0, 100.0}, [](auto& c) -> auto& { return c.planner.risk.certificate_beyond_m; }),
       numberKey(
           "pull_to_vehicle_m", "gaussian_volume: the nearest point is taken this much nearer.", {0.0, 10.0},
           [](auto& c) -> auto& { return c.planner.risk.collision.pull_to_vehicle_m; }),
       numberKey(
           "measured_point_variance_m2", "gaussian_volume: each axis of a measured point's own error.", {0.0, 100.0},
           [](auto& c) -> auto& { return c.planner.risk.collision.measured_point_variance_m2; }),
       numberKey(
           "horizontal_base_m",
           "Standard deviation, along each horizontal axis, of where the vehicle will be on a motion, apart from how\n"
           "far it is off that already (nanomap-report LOG --tracking compares it with a flight): this,",
           kDeviation, [](auto& c) -> auto& { return c.planner.risk.horizontal.base_m; }),
       numberKey(
           "horizontal_per_speed_s", "plus this times its speed there,", kDeviation,
           [](auto& c) -> auto& { return c.planner.risk.horizontal.per_speed_s; }),
       numberKey(
           "horizontal_per_time_m_s", "plus this times the time until then.", kDeviation,
           [](auto& c) -> auto& { return c.planner.risk.horizontal.per_time_m_s; }),
       numberKey(
           "vertical_base_m", "The same along the vertical: this,", kDeviation,
           [](auto& c) -> auto& { return c.planner.risk.vertical.base_m; }),
       numberKey(
           "vertical_per_speed_s", "plus this times its speed there,", kDeviation,
           [](auto& c) -> auto& { return c.planner.risk.vertical.per_speed_s; }),
       numberKey(
           "vertical_per_time_m_s", "plus this times the time until then.", kDeviation,
           [](auto& c) -> auto& { return c.planner.risk.vertical.per_time_m_s; })},
      {}};
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    const auto status = static_cast<Status>(i);
    section.keys.push_back(numberKey(
        priorName(status), std::string(priorHelp(status)),
        kProbability, [i](auto& c) -> auto& { return c.planner.risk.prior[i]; }));
  }
  return section;
}

Section headingSection() {
  return {"heading",
          "How the vehicle turns: the camera looks where it flies, and around when it is blocked.",
          {numberKey(
               "max_rate_rad_s", "Fastest turn; not below sweep_rate_rad_s.", {0.0, 100.0, true},
               [](auto& c) -> auto& { return c.planner.heading.max_rate_rad_s; }),
           numberKey(
               "reach_s", "The heading handed out can be reached in this time.", {0.0, 10.0, true},
               [](auto& c) -> auto& { return c.planner.heading.reach_s; }),
           numberKey(
               "min_speed_m_s", "Slower than that, a velocity has no direction worth looking in.", {0.0, 100.0},
               [](auto& c) -> auto& { return c.planner.heading.min_speed_m_s; }),
           numberKey(
               "sweep_amplitude_rad", "How far to each side of the goal a blocked vehicle looks.",
               {0.01, std::numbers::pi}, [](auto& c) -> auto& { return c.planner.heading.sweep_amplitude_rad; }),
           numberKey(
               "sweep_rate_rad_s", "How fast it looks around.", {0.0, 100.0, true},
               [](auto& c) -> auto& { return c.planner.heading.sweep_rate_rad_s; })},
          {}};
}

Section detourSection() {
  return {
      "detour",
      "The way round what is wider than the camera sees: the course turns away from the goal, to one side, and leans\n"
      "back as the vehicle gets on.",
      {durationKey(
           "patience_s", "A vehicle that comes no nearer to its goal for this long looks for a way round.",
           {0.0, 600.0, true}, [](auto& c) -> auto& { return c.planner.detour.patience; }),
       numberKey(
           "turn_rate_rad_s", "How fast the course turns away from the goal, and back.", {0.0, 10.0, true},
           [](auto& c) -> auto& { return c.planner.detour.turn_rate_rad_s; }),
       numberKey(
           "lean_rad", "How far the course leans towards what is gone round, from where the vehicle flies.",
           {0.0, 1.5, true}, [](auto& c) -> auto& { return c.planner.detour.lean_rad; }),
       durationKey(
           "give_up_after_s", "An attempt to one side that takes longer is given up; 0: no detours.", {0.0, 3600.0},
           [](auto& c) -> auto& { return c.planner.detour.give_up_after; }),
       numberKey(
           "return_m",
           "An attempt that leads back to within this of where it began is given up, too, once it has led away from\n"
           "there by twice as much. Less among small rooms.",
           {0.0, 1000.0, true}, [](auto& c) -> auto& { return c.planner.detour.return_m; }),
       numberKey(
           "near_goal_m", "Nearer to its goal, a vehicle that is held up looks for no way round.", {0.0, 1000.0},
           [](auto& c) -> auto& { return c.planner.detour.near_goal_m; })},
      {}};
}

Section trackingSection() {
  return {
      "tracking",
      "A vehicle this near to the motion in force is taken to follow it, and the next plan starts from that motion,\n"
      "so that setpoints have no steps; else the plan starts from the state as measured. 0: always as measured.",
      {numberKey(
           "max_position_error_m", "Distance from where it should be.", {0.0, 10.0},
           [](auto& c) -> auto& { return c.planner.tracking.max_position_error_m; }),
       numberKey(
           "recovery_s",
           "How soon a vehicle beside the motion in force is taken to be back on it, coming evenly: motions are\n"
           "judged where that takes it, and brakes until it is. 0: as if it were where it should be; else 0.5 or more.",
           {0.0, 60.0}, [](auto& c) -> auto& { return c.planner.tracking.recovery_s; }),
       numberKey(
           "max_velocity_error_m_s", "Difference to the velocity that it should have.", {0.0, 100.0},
           [](auto& c) -> auto& { return c.planner.tracking.max_velocity_error_m_s; })},
      {}};
}

}  // namespace

std::vector<Section> plannerSections() {
  return {planningSection(), limitsSection(),  horizonSection(), goalDirectedSection(), objectiveSection(),
          riskSection(),     headingSection(), detourSection(),  trackingSection()};
}

}  // namespace nanomap
