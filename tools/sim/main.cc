#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "firmware_app/configuration/load.h"
#include "firmware_app/supervision/end_signals.h"
#include "tools/replay/plan_summary.h"
#include "tools/sim/arguments.h"
#include "tools/sim/blindness.h"
#include "tools/sim/live_flight.h"
#include "tools/sim/lockstep_flight.h"

namespace nanomap::sim {
namespace {

std::string verdictLine(const generate::SensedFlightOptions& options, const FlightVerdict& verdict, double flown_s,
                        double flown_m) {
  return fmt::format("scene '{}', seed {}: {} after {:.1f} s and {:.1f} m", options.scene, options.seed,
                     toString(verdict.outcome), flown_s, flown_m);
}

std::string speedLine(const FlightVerdict& verdict, double flown_s, double flown_m) {
  return fmt::format("speed: mean {:.2f} m/s, top {:.2f} m/s; clearance {:.2f} m or more", flown_m / flown_s,
                     verdict.top_speed_m_s, verdict.min_clearance_m);
}

double rms(double square_sum, std::uint64_t count) {
  return count > 0 ? std::sqrt(square_sum / static_cast<double>(count)) : 0.0;
}

/// Time, way and speed count from the departure on.
std::string summaryOf(const generate::SensedFlightOptions& options, const LockstepFlight& flight) {
  const LockstepSummary& flown = flight.flown;
  Text text;
  text.line("{}", verdictLine(options, flown, flight.flown_s(), flown.flown_m));
  if (flown.departure) text.line("{}", speedLine(flown, flight.flown_s(), flown.flown_m));
  text.line("broken off for a fault {} times; autopilot's failsafes: {}", flown.braked, flown.failsafes);
  text.line("tracking error: rms {:.3f} m, max {:.3f} m; drift at the end {:.2f} m", flown.tracking.rms_m(),
            flown.tracking.worst_m, flight.sensed.final_error_m);
  writePlans(text, flown.plans);
  return text.take();
}

/// Time, way and speed count from the departure on.
std::string summaryOf(const generate::SensedFlightOptions& options, const LiveFlight& flight) {
  constexpr double kDegreesARadian = 180.0 / std::numbers::pi;
  const LiveFlightSummary& flown = flight.flown;
  const double flown_s = flown.departure ? toSeconds(flown.end - *flown.departure) : 0.0;
  Text text;
  text.line("{}", verdictLine(options, flown, flown_s, flown.flown_m));
  if (flown.departure) text.line("{}", speedLine(flown, flown_s, flown.flown_m));
  text.line("the vehicle's pose between those told: rms {:.1f} mm and {:.2f} degrees, max {:.1f} mm and {:.2f} degrees",
            1e3 * rms(flown.extrapolation.square_sum_m2, flown.extrapolation.count),
            kDegreesARadian * rms(flown.extrapolation.square_sum_rad2, flown.extrapolation.count),
            1e3 * flown.extrapolation.worst_m, kDegreesARadian * flown.extrapolation.worst_rad);
  text.line("drift at the end {:.2f} m; sensors late by {:.1f} ms or less; messages not sent: {}",
            flight.sensed.final_error_m, 1e3 * toSeconds(flown.worst_lateness), flown.unpublished);
  for (const auto& [channel, count] : flight.sensed.messages) text.line("  {:<16} {:>6}", channel, count);
  return text.take();
}

/// @return did it arrive?
bool runLive(const Arguments& arguments, const Configuration& configuration) {
  const EndSignals signals;
  bool stopped = false;
  const generate::SensedFlight flight(sensedFlightOf(arguments));
  LiveFlightOptions options;
  options.autopilot_url = arguments.autopilot_url;
  if (arguments.heading_deg) options.heading_rad = *arguments.heading_deg * std::numbers::pi / 180.0;
  options.vehicle_radius_m = simulation::MulticopterParameters().radius_m;
  options.duration = fromSeconds(arguments.duration_s);
  options.faults = faultsOf(arguments);
  options.message_faults = messageFaultsOf(arguments);
  options.log = arguments.log;
  const auto tell = [](const std::string& text) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
  };
  const LiveFlight flown = flyLive(configuration, flight, options, tell,
                                   [&] { return stopped = stopped || signals.wait(Duration::zero()); });
  fmt::print("{}", summaryOf(flight.options(), flown));
  return flown.flown.outcome == Outcome::kAtGoal;
}

/// @return did it arrive?
bool runInLockstep(const Arguments& arguments, const Configuration& configuration) {
  const generate::SensedFlight flight(sensedFlightOf(arguments));
  const LockstepFlight flown = flyInLockstep(configuration, flight, fromSeconds(arguments.duration_s),
                                             faultsOf(arguments), arguments.recordings);
  fmt::print("{}", summaryOf(flight.options(), flown));
  return flown.flown.outcome == Outcome::kAtGoal;
}

/// @return did all arrive?
bool runSeeds(const Arguments& arguments, const Configuration& configuration) {
  generate::SensedFlightOptions options = sensedFlightOf(arguments);
  std::vector<LockstepFlight> flights;
  for (std::uint64_t i = 0; i < arguments.flights; ++i, ++options.seed) {
    flights.push_back(flyInLockstep(configuration, generate::SensedFlight(options), fromSeconds(arguments.duration_s),
                                    faultsOf(arguments)));
  }
  fmt::print("{}", tableOf(options.scene, flights));
  return std::ranges::all_of(flights,
                             [](const LockstepFlight& flight) { return flight.flown.outcome == Outcome::kAtGoal; });
}

bool run(Arguments& arguments) {
  if (arguments.blind) {
    const std::vector<std::string> blind = blindToObstacles();
    arguments.overrides.insert(arguments.overrides.begin(), blind.begin(), blind.end());
  }
  const Configuration configuration = loadConfiguration(arguments.config, arguments.overrides);
  if (arguments.live) return runLive(arguments, configuration);
  return arguments.flights == 1 ? runInLockstep(arguments, configuration) : runSeeds(arguments, configuration);
}

}  // namespace
}  // namespace nanomap::sim

int main(int argc, char** argv) {
  CLI::App app(
      "Flies a simulated vehicle through a scene in simulated time, by the stages of the flight process themselves.\n"
      "With --live, an autopilot flies its own vehicle: this renders what its depth camera would see and what its\n"
      "drifting estimator would say, sends both over LCM, and judges the flight.\n"
      "Exit code 0: it stands at the goal, in all flights; 2: it does not; 1: it could not be flown.",
      "nanomap-sim");
  nanomap::sim::Arguments arguments;
  nanomap::sim::addOptions(app, arguments);
  CLI11_PARSE(app, argc, argv);
  constexpr int kNotArrived = 2;
  try {
    return nanomap::sim::run(arguments) ? EXIT_SUCCESS : kNotArrived;
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-sim: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
