#include "planner/planner_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/gaps_of_tile.h"
#include "planner/brake.h"

namespace nanomap {
namespace {

// Together they keep the period of a sweep far above a nanosecond.
constexpr double kFastestTurn_rad_s = 100.0;
constexpr double kSmallestSweep_rad = 0.01;
/// A vehicle that comes back sooner might pass something between two samples of its motion.
constexpr double kSoonestRecovery_s = 0.5;

void require(bool holds, const std::string& name, double value, const std::string& range) {
  if (holds) return;
  throw std::invalid_argument("planner parameter " + name + " is " + std::to_string(value) + ": must be " + range);
}

void requirePositive(const std::string& name, double value) {
  require(std::isfinite(value) && value > 0.0, name, value, "above 0");
}

void requireNotNegative(const std::string& name, double value) {
  require(std::isfinite(value) && value >= 0.0, name, value, "0 or more");
}

void requireAtLeast(const std::string& name, double value, const std::string& other_name, double other) {
  require(std::isfinite(value) && value >= other, name, value, "at least " + other_name + ", " + std::to_string(other));
}

void requireProbability(const std::string& name, double value) {
  require(value >= 0.0 && value <= 1.0, name, value, "a probability, 0 .. 1");
}

void check(const MotionLimits& limits) {
  requirePositive("limits.horizontal_at_rest_m_s2", limits.horizontal_at_rest_m_s2);
  requireAtLeast("limits.horizontal_at_full_m_s2", limits.horizontal_at_full_m_s2, "limits.horizontal_at_rest_m_s2",
                 limits.horizontal_at_rest_m_s2);
  requirePositive("limits.full_speed_m_s", limits.full_speed_m_s);
  requirePositive("limits.top_speed_m_s", limits.top_speed_m_s);
  requirePositive("limits.vertical_m_s2", limits.vertical_m_s2);
  requirePositive("limits.ramp_s", limits.ramp_s);
  requirePositive("limits.jerk_m_s3", limits.jerk_m_s3);
}

void check(const HorizonParameters& horizon) {
  requirePositive("horizon.push_s", horizon.push_s);
  requirePositive("horizon.min_s", horizon.min_s);
  requireAtLeast("horizon.max_s", horizon.max_s, "horizon.min_s", horizon.min_s);
  requirePositive("horizon.distance_m", horizon.distance_m);
}

void check(const ObjectiveParameters& objective) {
  requireNotNegative("objective.speed_weight_s2_m2", objective.speed_weight_s2_m2);
  requireNotNegative("objective.altitude_weight_1_m2", objective.altitude_weight_1_m2);
  require(std::isfinite(objective.min_altitude_W_m), "objective.min_altitude_W_m", objective.min_altitude_W_m,
          "finite");
  requireAtLeast("objective.max_altitude_W_m", objective.max_altitude_W_m, "objective.min_altitude_W_m",
                 objective.min_altitude_W_m);
  requireNotNegative("objective.out_of_band_cost", objective.out_of_band_cost);
  require(std::isfinite(objective.collision_reward), "objective.collision_reward", objective.collision_reward,
          "finite");
  requirePositive("objective.goal_tolerance_m", objective.goal_tolerance_m);
}

void check(const std::string& name, const DeviationGrowth& growth) {
  requireNotNegative(name + ".base_m", growth.base_m);
  requireNotNegative(name + ".per_speed_s", growth.per_speed_s);
  requireNotNegative(name + ".per_time_m_s", growth.per_time_m_s);
}

void check(const RiskParameters& risk) {
  requireProbability("risk.max_risk", risk.max_risk);
  check("risk.horizontal", risk.horizontal);
  check("risk.vertical", risk.vertical);
  requireNotNegative("risk.bubble_margin_m", risk.bubble_margin_m);
  requireNotNegative("risk.beside_beyond_m", risk.beside_beyond_m);
  requireNotNegative("risk.certificate_beyond_m", risk.certificate_beyond_m);
  requirePositive("risk.collision.vehicle_radius_m", risk.collision.vehicle_radius_m);
  requireNotNegative("risk.collision.pull_to_vehicle_m", risk.collision.pull_to_vehicle_m);
  requireNotNegative("risk.collision.measured_point_variance_m2", risk.collision.measured_point_variance_m2);
  require(risk.query.k >= 1 && risk.query.k <= kMaxNeighbours, "risk.query.k", risk.query.k,
          "1 .. " + std::to_string(kMaxNeighbours));
  requireNotNegative("risk.query.open_window_px", risk.query.open_window_px);
  requireProbability("risk.query.open_range_fraction", risk.query.open_range_fraction);
  requireNotNegative("risk.query.open_frame_m", risk.query.open_frame_m);
  require(risk.query.narrow_gap_px >= 0 && risk.query.narrow_gap_px <= GapsOfTile::kWidest_px,
          "risk.query.narrow_gap_px", risk.query.narrow_gap_px, "0 .. " + std::to_string(GapsOfTile::kWidest_px));
  requireNotNegative("risk.query.certify_sigmas", risk.query.certify_sigmas);
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    requireProbability("risk.prior of '" + std::string(toString(static_cast<Status>(i))) + "'", risk.prior[i]);
  }
}

void check(const HeadingParameters& heading) {
  require(heading.max_rate_rad_s > 0.0 && heading.max_rate_rad_s <= kFastestTurn_rad_s, "heading.max_rate_rad_s",
          heading.max_rate_rad_s, "above 0, up to " + std::to_string(kFastestTurn_rad_s));
  requirePositive("heading.reach_s", heading.reach_s);
  requireNotNegative("heading.min_speed_m_s", heading.min_speed_m_s);
  require(heading.sweep_amplitude_rad >= kSmallestSweep_rad && heading.sweep_amplitude_rad <= std::numbers::pi,
          "heading.sweep_amplitude_rad", heading.sweep_amplitude_rad,
          std::to_string(kSmallestSweep_rad) + " .. " + std::to_string(std::numbers::pi));
  requirePositive("heading.sweep_rate_rad_s", heading.sweep_rate_rad_s);
  requireAtLeast("heading.max_rate_rad_s", heading.max_rate_rad_s, "heading.sweep_rate_rad_s",
                 heading.sweep_rate_rad_s);
}

void check(const DetourParameters& detour) {
  require(detour.patience > Duration::zero(), "detour.patience", toSeconds(detour.patience), "above 0 s");
  requirePositive("detour.turn_rate_rad_s", detour.turn_rate_rad_s);
  require(detour.lean_rad > 0.0 && detour.lean_rad < std::numbers::pi / 2.0, "detour.lean_rad", detour.lean_rad,
          "above 0, below a right angle");
  require(detour.give_up_after >= Duration::zero(), "detour.give_up_after", toSeconds(detour.give_up_after),
          "0 s or more");
  requirePositive("detour.return_m", detour.return_m);
  requireNotNegative("detour.near_goal_m", detour.near_goal_m);
}

/// How far away the vehicle stands after a plan's hardest start from rest and its brake.
double gainFromRest_m(const PlannerParameters& parameters) {
  const Vec3 acceleration_m_s2(parameters.limits.horizontal_m_s2(0.0), 0.0, 0.0);
  const Trajectory start = primitive({}, {}, acceleration_m_s2, parameters.horizon.at(0.0), parameters.limits);
  return brakeAfter(start, parameters.brake_after_s, parameters.limits).atEnd().position_m.x();
}

}  // namespace

PrimitiveTimes HorizonParameters::at(double speed_m_s) const {
  const double flight_s = speed_m_s > 0.0 ? distance_m / speed_m_s : std::numeric_limits<double>::infinity();
  return {push_s, std::clamp(flight_s, min_s, max_s)};
}

void check(const PlannerParameters& parameters) {
  check(parameters.limits);
  check(parameters.horizon);
  requirePositive("goal_directed.approach_s", parameters.goal_directed.approach_s);
  requirePositive("goal_directed.response_s", parameters.goal_directed.response_s);
  check(parameters.objective);
  check(parameters.risk);
  check(parameters.heading);
  check(parameters.detour);
  requireNotNegative("tracking.max_position_error_m", parameters.tracking.max_position_error_m);
  const double recovery_s = parameters.tracking.recovery_s;
  require(recovery_s == 0.0 || (std::isfinite(recovery_s) && recovery_s >= kSoonestRecovery_s), "tracking.recovery_s",
          recovery_s, "0, or at least " + std::to_string(kSoonestRecovery_s) + " s");
  requireNotNegative("tracking.max_velocity_error_m_s", parameters.tracking.max_velocity_error_m_s);
  requirePositive("brake_after_s", parameters.brake_after_s);
  requireAtLeast("horizon.push_s", parameters.horizon.push_s, "brake_after_s", parameters.brake_after_s);
  requireAtLeast("horizon.min_s", parameters.horizon.min_s, "brake_after_s", parameters.brake_after_s);
  const double gain_m = gainFromRest_m(parameters);
  require(parameters.objective.least_gain_m >= 0.0 && parameters.objective.least_gain_m < gain_m,
          "objective.least_gain_m", parameters.objective.least_gain_m,
          "0 or more, and below what a plan gains from rest, " + std::to_string(gain_m) + ", or it never takes off");
  require(parameters.samples >= 1, "samples", parameters.samples, "at least 1");
  require(parameters.brake_samples >= 1, "brake_samples", parameters.brake_samples, "at least 1");
  require(parameters.max_state_age > Duration::zero(), "max_state_age", toSeconds(parameters.max_state_age),
          "above 0 s");
}

}  // namespace nanomap
