#pragma once

#include <cstdint>
#include <deque>
#include <random>

#include "core/correction.h"
#include "core/drift.h"
#include "core/pose_buffer.h"
#include "core/time.h"
#include "tools/simulation/random.h"
#include "tools/simulation/vehicle_state.h"

namespace nanomap::simulation {

struct VioParameters {
  /// The error of relative position has this standard deviation after `drift.after`. With the square-root law the
  /// velocity error forgets itself; with the linear law it is drawn once for the whole flight.
  DriftModel drift;
  Duration period = std::chrono::milliseconds(10);
  Duration velocity_memory = std::chrono::milliseconds(200);  ///< correlation time; 0: a random walk in position
  Duration window = std::chrono::seconds(5);                  ///< of the sliding-window optimiser
  Duration keyframe_period = std::chrono::milliseconds(100);  ///< between corrected poses; a multiple of `period`
};

/// What the estimator says about one moment.
struct VioEstimate {
  BodyPose pose;
  Vec3 velocity_W_m_s = Vec3::Zero();
};

/// A visual-inertial estimator whose position drifts as configured, while the optimiser behind it gets the last seconds
/// right some time later. Orientation is exact: gravity holds roll and pitch, and position drift is what NanoMap
/// models. Threads: one.
class VioSimulator {
 public:
  /// @throws std::invalid_argument naming the parameter and its value
  VioSimulator(const VioParameters& parameters, std::uint64_t seed);

  /// The estimate at `stamp`, for the vehicle's true state then. Call once a period, stamps a period apart.
  [[nodiscard]] VioEstimate estimate(Time stamp, const VehicleState& truth);

  /// Moves the estimator's world by `distance_m` in a random horizontal direction; the epoch rises.
  void jump(double distance_m);

  /// The true poses of the window that ends at the newest estimate, in the world of the present epoch; empty if there
  /// was no estimate yet.
  [[nodiscard]] Correction correct();

  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

 private:
  void drift();

  VioParameters parameters_;
  Random random_;
  std::normal_distribution<double> normal_;
  double memory_;  ///< correlation of the velocity errors of neighbouring periods
  Vec3 velocity_error_std_m_s_;
  Vec3 velocity_error_W_m_s_;
  Vec3 position_error_W_m_ = Vec3::Zero();
  std::uint32_t epoch_ = 0;
  std::uint64_t estimates_ = 0;
  std::uint64_t corrections_ = 0;
  std::deque<CorrectedPose> window_;  ///< true poses at keyframes
};

}  // namespace nanomap::simulation
