#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"
#include "tools/generate/sensed_flight.h"

namespace nanomap::sim {

/// What a sensor does not do for a while.
struct Outage {
  [[nodiscard]] bool holds(Duration since_departure) const {
    return since_departure >= after && since_departure < after + lasts;
  }

  Duration after{};  ///< since the vehicle left its start
  Duration lasts{};
};

/// How far the estimator's world jumps.
struct Jump {
  Duration after{};  ///< since the vehicle left its start
  double distance_m = 0.0;
};

struct SensorFaultPlanParameters {
  std::optional<Outage> camera;
  std::optional<Outage> estimator;
  std::optional<Jump> jump;
};

/// Seconds after the departure and seconds, as in "5:1". @throws std::invalid_argument naming the option and the text
[[nodiscard]] Outage parseOutage(std::string_view option, std::string_view text);

/// Seconds after the departure and metres, likewise.
[[nodiscard]] Jump parseJump(std::string_view option, std::string_view text);

/// Faults of the sensors in mid-flight. Threads: one.
class SensorFaultPlan {
 public:
  explicit SensorFaultPlan(const SensorFaultPlanParameters& parameters) : parameters_(parameters) {}

  /// What befalls them at `stamp`; a jump is told once.
  /// @param departure  empty: still at the start
  [[nodiscard]] generate::SensorFaults at(Time stamp, std::optional<Time> departure);

 private:
  SensorFaultPlanParameters parameters_;
  bool jumped_ = false;
};

}  // namespace nanomap::sim
