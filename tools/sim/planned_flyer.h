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
#include "tools/sim/flight_judge.h"
#include "tools/sim/sensor_fault_plan.h"
#include "tools/simulation/multicopter.h"
#include "tools/simulation/position_controller.h"
#include "tools/simulation/scene.h"

namespace nanomap::sim {

/// How far the vehicle was from what it was told, over all estimates in flight.
struct TrackingError {
  double worst_m = 0.0;
  double square_sum_m2 = 0.0;
  std::uint64_t count = 0;
};

struct PlannedFlightSummary : FlightVerdict {
  TrackingError tracking;
  PlanStatistics plans;
};

/// A simulated vehicle that flies what the planner decides: messages go through the pipeline as they arrive, a plan is
/// made whenever a view enters the chain, and the vehicle's position controller follows the decision in force by the
/// estimator's word. All messages are recorded. The simulated time is the only one: the same options fly the same
/// flight.
/// Threads: one.
class PlannedFlyer : public generate::Flyer {
 public:
  /// Borrows configuration, scene and log. Decisions are recorded too.
  PlannedFlyer(const Configuration& configuration, const simulation::Scene& scene, Time start,
               const simulation::MulticopterParameters& vehicle, const SensorFaultPlanParameters& faults,
               LogWriter& log);

  [[nodiscard]] simulation::VehicleState at(Time stamp) override;
  void onEstimate(const simulation::VioEstimate& estimate) override;
  void onArrival(const std::string& channel, Time arrival, Bytes message) override;
  [[nodiscard]] generate::SensorFaults faultsAt(Time stamp) override;
  [[nodiscard]] bool isDone() const override { return summary_.outcome != Outcome::kUnderWay; }

  [[nodiscard]] const PlannedFlightSummary& summary() const { return summary_; }

 private:
  void plan(Time arrival);

  const Configuration& configuration_;
  LogWriter& log_;
  FlightJudge judge_;  ///< by the vehicle's own radius, whatever the configuration believes
  SensorFaultPlan faults_;

  Pipeline pipeline_;
  RecedingHorizon horizon_;
  ChainSnapshot snapshot_;

  simulation::Multicopter vehicle_;
  simulation::PositionController controller_;
  simulation::MulticopterCommand command_;
  Motion hold_W_;  ///< until the first decision that may be flown
  Time now_;
  std::optional<Time> last_estimate_;
  PlannedFlightSummary summary_;
};

}  // namespace nanomap::sim
