#include "tools/simulation/vio.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace nanomap::simulation {
namespace {

void require(bool holds, const char* name, double value, const char* rule) {
  if (holds) return;
  throw std::invalid_argument(std::string("vio: ") + name + " is " + std::to_string(value) + ", must be " + rule);
}

void check(const VioParameters& p) {
  require(p.period > Duration::zero(), "period", toSeconds(p.period), "positive");
  require(p.window > Duration::zero(), "window", toSeconds(p.window), "positive");
  require(p.keyframe_period >= p.period, "keyframe_period", toSeconds(p.keyframe_period), "a period or more");
  require(p.velocity_memory >= Duration::zero(), "velocity_memory", toSeconds(p.velocity_memory), "0 or more");
  require(p.drift.after >= p.period, "drift.after", toSeconds(p.drift.after), "a period or more");
  require(p.drift.horizontal_std_m >= 0.0, "drift.horizontal_std_m", p.drift.horizontal_std_m, "0 or more");
  require(p.drift.vertical_std_m >= 0.0, "drift.vertical_std_m", p.drift.vertical_std_m, "0 or more");
}

/// Correlation of the velocity errors of neighbouring periods.
double memoryPerPeriod(const VioParameters& parameters) {
  if (parameters.drift.law == GrowthLaw::kLinear) return 1.0;
  if (parameters.velocity_memory == Duration::zero()) return 0.0;
  return std::exp(-toSeconds(parameters.period) / toSeconds(parameters.velocity_memory));
}

/// Standard deviation after `steps` periods of a position that integrates, over periods of `period_s`, velocity errors
/// of unit standard deviation whose neighbours are correlated by `memory`.
double positionStdOfUnitVelocity(std::int64_t steps, double period_s, double memory) {
  double variance_steps = static_cast<double>(steps);
  double correlation = 1.0;
  for (std::int64_t lag = 1; lag < steps; ++lag) {
    correlation *= memory;
    variance_steps += 2.0 * static_cast<double>(steps - lag) * correlation;
  }
  return period_s * std::sqrt(variance_steps);
}

}  // namespace

VioSimulator::VioSimulator(const VioParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), random_(seed), memory_(memoryPerPeriod(parameters)) {
  check(parameters);
  const double position_std_s =
      positionStdOfUnitVelocity(parameters.drift.after / parameters.period, toSeconds(parameters.period), memory_);
  velocity_error_std_m_s_ = parameters.drift.variance_W(parameters.drift.after).cwiseSqrt() / position_std_s;
  for (int axis = 0; axis < 3; ++axis) velocity_error_W_m_s_[axis] = velocity_error_std_m_s_[axis] * normal_(random_);
}

void VioSimulator::drift() {
  for (int axis = 0; axis < 3; ++axis) {
    const double news_m_s = std::sqrt(1.0 - memory_ * memory_) * velocity_error_std_m_s_[axis] * normal_(random_);
    velocity_error_W_m_s_[axis] = memory_ * velocity_error_W_m_s_[axis] + news_m_s;
  }
  position_error_W_m_ += toSeconds(parameters_.period) * velocity_error_W_m_s_;
}

VioEstimate VioSimulator::estimate(Time stamp, const VehicleState& truth) {
  if (estimates_ > 0) drift();
  const auto periods_a_keyframe = static_cast<std::uint64_t>(parameters_.keyframe_period / parameters_.period);
  if (estimates_ % periods_a_keyframe == 0) {
    window_.push_back({stamp, truth.T_W_B});
    while (window_.front().stamp < stamp - parameters_.window) window_.pop_front();
  }
  VioEstimate estimate;
  estimate.pose.stamp = stamp;
  estimate.pose.T_W_B = truth.T_W_B;
  estimate.pose.T_W_B.translation_m += position_error_W_m_;
  estimate.pose.epoch = epoch_;
  estimate.pose.sequence = estimates_++;
  if (parameters_.drift.law == GrowthLaw::kSquareRoot) {
    estimate.pose.increment =
        DriftIncrement{parameters_.drift.variance_W(parameters_.period).asDiagonal(), parameters_.period};
  }
  estimate.velocity_W_m_s = truth.velocity_W_m_s + velocity_error_W_m_s_;
  return estimate;
}

void VioSimulator::jump(double distance_m) {
  const double heading_rad = uniform(random_, -std::numbers::pi, std::numbers::pi);
  position_error_W_m_ += distance_m * Vec3(std::cos(heading_rad), std::sin(heading_rad), 0.0);
  ++epoch_;
}

Correction VioSimulator::correct() {
  Correction correction;
  correction.epoch = epoch_;
  correction.sequence = corrections_++;
  correction.poses.assign(window_.begin(), window_.end());
  return correction;
}

}  // namespace nanomap::simulation
