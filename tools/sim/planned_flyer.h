#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/snapshot.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/pipeline.h"
#include "planner/receding_horizon.h"
#include "tools/generate/sensed_flight.h"
#include "tools/replay/plan_statistics.h"
#include "tools/simulation/multicopter.h"
#include "tools/simulation/position_controller.h"
#include "tools/simulation/scene.h"

namespace nanomap::sim {

enum class Outcome : std::uint8_t {
  kUnderWay,
  kAtGoal,     ///< stands there
  kCollision,  ///< the sphere that holds the vehicle touched something
};

[[nodiscard]] std::string_view toString(Outcome outcome);

/// How far the vehicle was from what it was told, over all estimates in flight.
struct TrackingError {
  double worst_m = 0.0;
  double square_sum_m2 = 0.0;
  std::uint64_t count = 0;
};

struct PlannedFlightSummary {
  Outcome outcome = Outcome::kUnderWay;
  Time end{};                    ///< of the outcome, or the last moment simulated
  double min_clearance_m = 0.0;  ///< of the vehicle's centre, to obstacles and ground
  double top_speed_m_s = 0.0;
  TrackingError tracking;
  PlanStatistics plans;
};

/// A simulated vehicle that flies what the planner decides: messages go through the pipeline as they arrive, a plan is
/// made whenever a view enters the chain, and the vehicle's position controller follows the decision in force by the
/// estimator's word. The simulated time is the only one: the same options fly the same flight.
/// Threads: one.
class PlannedFlyer : public generate::Flyer {
 public:
  /// Borrows all but the vehicle's parameters. Decisions are recorded in `log` too.
  PlannedFlyer(const Configuration& configuration, const simulation::Scene& scene, Time start,
               const simulation::MulticopterParameters& vehicle, LogWriter& log);

  [[nodiscard]] simulation::VehicleState at(Time stamp) override;
  void onEstimate(const simulation::VioEstimate& estimate) override;
  void onArrival(const std::string& channel, Time arrival, Bytes message) override;
  [[nodiscard]] bool isDone() const override { return summary_.outcome != Outcome::kUnderWay; }

  [[nodiscard]] const PlannedFlightSummary& summary() const { return summary_; }

 private:
  void plan(Time arrival);
  void judge(const simulation::VehicleState& truth);

  const Configuration& configuration_;
  const simulation::Scene& scene_;
  LogWriter& log_;

  Pipeline pipeline_;
  RecedingHorizon horizon_;
  ChainSnapshot snapshot_;

  double vehicle_radius_m_;  ///< its own, whatever the configuration believes
  simulation::Multicopter vehicle_;
  simulation::PositionController controller_;
  simulation::MulticopterCommand command_;
  Motion hold_W_;  ///< until the first decision that may be flown
  Time now_;
  std::optional<Time> last_estimate_;
  PlannedFlightSummary summary_;
};

}  // namespace nanomap::sim
