#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/message_source.h"
#include "drivers/mavlink/autopilot_link.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/generate/sensed_flight.h"
#include "tools/sim/flight_judge.h"
#include "tools/sim/message_faults.h"
#include "tools/sim/sensor_fault_plan.h"
#include "tools/sim/true_motion.h"

namespace nanomap::sim {

/// What a live flight meets outside; all are borrowed.
struct LiveSurroundings {
  AutopilotLink& autopilot;  ///< whose vehicle flies
  MessageSource& heard;      ///< what others say about the flight; recorded
  std::function<bool(const std::string& channel, Bytes message)> publish;
  std::function<Time()> now;
  std::function<bool()> stopped;  ///< by the user
  LogWriter* log = nullptr;       ///< null: none is written
};

struct LiveFlightSummary : FlightVerdict {
  ExtrapolationError extrapolation;
  Duration worst_lateness{};      ///< of a sensor's moment
  std::uint64_t unpublished = 0;  ///< messages that the network refused
};

/// A vehicle that an autopilot flies in real time. Sensors look, and messages are published, when the clock has come to
/// their moments; those of a machine that is too slow come late, and a camera that is late by more than a frame leaves
/// frames out. Threads: one.
class LiveFlyer : public generate::Flyer {
 public:
  /// @param configuration, scene  must outlive the flyer
  /// @param motion  knows the scene's place, and where the vehicle was last
  LiveFlyer(const Configuration& configuration, const simulation::Scene& scene, double vehicle_radius_m,
            Duration frame_period, TrueMotion motion, const SensorFaultPlanParameters& faults,
            const std::vector<PlannedMessageFault>& message_faults, LiveSurroundings surroundings);

  /// Waits for the moment. @throws std::runtime_error if the autopilot no longer tells where the vehicle is
  [[nodiscard]] simulation::VehicleState at(Time stamp) override;
  void onEstimate(const simulation::VioEstimate& estimate) override;
  void onArrival(const std::string& channel, Time arrival, Bytes message) override;
  [[nodiscard]] generate::SensorFaults faultsAt(Time stamp) override;
  [[nodiscard]] bool isDone() const override;

  [[nodiscard]] LiveFlightSummary summary() const;

 private:
  void publish(const std::string& channel, Time arrival, Bytes message);
  void waitUntil(Time time);
  void takePoses();

  const simulation::Scene& scene_;
  double arrival_tolerance_m_;
  Duration frame_period_;
  LiveSurroundings surroundings_;
  TrueMotion motion_;
  FlightJudge judge_;
  SensorFaultPlan faults_;
  MessageFaults message_faults_;
  Time next_sign_of_life_{};
  Time stamp_{};                    ///< of what was asked for last
  simulation::VehicleState truth_;  ///< then
  LiveFlightSummary summary_;
};

}  // namespace nanomap::sim
