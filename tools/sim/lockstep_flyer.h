#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware_app/configuration/configuration.h"
#include "firmware_app/recorder/recorder.h"
#include "firmware_app/stages/stages.h"
#include "tools/generate/sensed_flight.h"
#include "tools/replay/plan_statistics.h"
#include "tools/sim/flight_judge.h"
#include "tools/sim/lockstep_autopilot.h"
#include "tools/sim/sensor_fault_plan.h"
#include "tools/simulation/scene.h"

namespace nanomap::sim {

/// How far the vehicle was from the motion in force, by the estimator's word, at all estimates in flight.
struct TrackingError {
  double worst_m = 0.0;
  double square_sum_m2 = 0.0;
  std::uint64_t count = 0;

  void add(double error_m);
  [[nodiscard]] double rms_m() const;
};

struct LockstepSummary : FlightVerdict {
  TrackingError tracking;
  PlanStatistics plans;         ///< while the vehicle was ours
  std::uint64_t failsafes = 0;  ///< of the autopilot
  std::uint64_t braked = 0;     ///< times that the flight was broken off for a fault
};

/// A flight of the flight process's own stages, from messages to setpoints, with its recorder, in simulated time:
/// everything that has arrived is taken in, planned for and told to the autopilot at once, by turns on one thread. A
/// pilot hands the vehicle over as soon as the flight process says that it is ready. The same options fly the same
/// flight, and record the same bytes.
/// Threads: one.
class LockstepFlyer : public generate::Flyer {
 public:
  /// Borrows configuration and scene.
  /// @param recordings  folder; empty: nothing is recorded
  /// @throws as Stages and Recorder
  LockstepFlyer(const Configuration& configuration, const simulation::Scene& scene, Time start,
                const simulation::MulticopterParameters& vehicle, const SensorFaultPlanParameters& faults,
                const std::optional<std::filesystem::path>& recordings);
  ~LockstepFlyer() override;

  [[nodiscard]] simulation::VehicleState at(Time stamp) override;
  void onEstimate(const simulation::VioEstimate& estimate) override;
  void onArrival(const std::string& channel, Time arrival, Bytes message) override;
  [[nodiscard]] generate::SensorFaults faultsAt(Time stamp) override;
  [[nodiscard]] bool isDone() const override { return summary_.outcome != Outcome::kUnderWay; }

  [[nodiscard]] const LockstepSummary& summary() const { return summary_; }

 private:
  void runUntil(Time time);
  void think(Time now);
  void act(Time now);

  Vec3 goal_W_m_;
  double arrival_tolerance_m_;
  FlightJudge judge_;  ///< by the vehicle's own radius, whatever the configuration believes
  SensorFaultPlan faults_;
  LockstepAutopilot autopilot_;
  Stages stages_;
  std::optional<Recorder> recorder_;
  Duration setpoint_period_;
  Time next_setpoint_;
  bool handed_over_ = false;
  State state_ = State::kWaiting;
  std::optional<Decision> in_force_;
  LockstepSummary summary_;
};

}  // namespace nanomap::sim
