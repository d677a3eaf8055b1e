#pragma once

#include <optional>

#include "core/time.h"
#include "drivers/recording/log_writer.h"
#include "tools/generate/sensed_flight.h"
#include "tools/simulation/flight_path.h"

namespace nanomap::generate {

struct FlightLogOptions : SensedFlightOptions {
  std::optional<Duration> duration;  ///< empty: until the vehicle stands at the goal
  simulation::FlightParameters flight;
};

/// A flight along a path that leads through the scene, as a log would have recorded it.
/// Threads: one.
class FlightLog {
 public:
  /// Builds the scene and finds a way through it. The goal's top speed is the flight's cruise speed.
  /// @throws std::exception with a message that names the option at fault
  explicit FlightLog(const FlightLogOptions& options);

  [[nodiscard]] const simulation::Scene& scene() const { return sensed_.scene(); }
  [[nodiscard]] Duration duration() const { return duration_; }

  /// @throws LogError if the log cannot be written
  SensedFlightSummary write(const LcmParameters& channels, LogWriter& log) const;

 private:
  SensedFlight sensed_;
  simulation::FlightPath path_;
  Duration duration_;
};

}  // namespace nanomap::generate
