#include "tools/generate/flight_log.h"

#include <stdexcept>
#include <string>

#include "tools/simulation/random.h"

namespace nanomap::generate {
namespace {

constexpr std::uint32_t kFlightStream = 1;

/// Follows a path, whatever the sensors say, and records that.
class PathFlyer : public Flyer {
 public:
  PathFlyer(const simulation::FlightPath& path, LogWriter& log) : path_(path), log_(log) {}

  [[nodiscard]] simulation::VehicleState at(Time stamp) override { return path_.at(stamp - SensedFlight::kStart); }
  void onArrival(const std::string& channel, Time arrival, Bytes message) override {
    log_.writeEncoded(channel, arrival, message);
  }

 private:
  const simulation::FlightPath& path_;
  LogWriter& log_;
};

const FlightLogOptions& checked(const FlightLogOptions& options) {
  if (options.duration && *options.duration <= Duration::zero()) {
    throw std::invalid_argument("flight log: duration is " + std::to_string(toSeconds(*options.duration)) +
                                ", must be positive");
  }
  return options;
}

SensedFlightOptions withCruiseSpeed(const FlightLogOptions& options) {
  SensedFlightOptions sensed = options;
  sensed.goal_speed_m_s = options.flight.cruise_speed_m_s;
  return sensed;
}

}  // namespace

FlightLog::FlightLog(const FlightLogOptions& options)
    : sensed_(withCruiseSpeed(checked(options))),
      path_(sensed_.scene(), options.flight, simulation::derivedSeed(options.seed, kFlightStream)),
      duration_(options.duration.value_or(path_.duration())) {}

SensedFlightSummary FlightLog::write(const LcmParameters& channels, LogWriter& log) const {
  PathFlyer flyer(path_, log);
  return sensed_.fly(channels, SensedFlight::kStart, duration_, flyer);
}

}  // namespace nanomap::generate
