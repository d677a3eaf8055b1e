#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware_app/configuration/load.h"
#include "tools/generate/paper_camera.h"
#include "tools/replay/plan_summary.h"
#include "tools/sim/planned_flyer.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::sim {
namespace {

struct Arguments {
  std::filesystem::path log;
  std::string config;
  std::vector<std::string> overrides;
  generate::SensedFlightOptions options;
  double duration_s = 120.0;
  double drift_5s_m = 0.2;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  generate::SensedFlightOptions& options = arguments.options;
  app.option_defaults()->take_last();
  app.add_option("--out", arguments.log,
                 "LCM log of the flight to write, decisions included; an existing one is replaced")
      ->required();
  app.add_option("--scene", options.scene, "What to fly through")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(simulation::kSceneNames.begin(), simulation::kSceneNames.end())));
  app.add_option("--seed", options.seed, "Draws scene, noise and drift; the same seed flies the same flight")
      ->capture_default_str();
  app.add_option("--speed", options.goal_speed_m_s, "Top speed that comes with the goal [m/s]")->capture_default_str();
  app.add_option("--duration", arguments.duration_s, "Give up after [s]")->capture_default_str();
  app.add_option("--drift-5s", arguments.drift_5s_m, "Standard deviation of position drift after 5 s, on each axis [m]")
      ->capture_default_str();
  app.add_option("--correction-hz", options.correction_hz, "Sliding-window corrections a second [Hz]; 0: none")
      ->capture_default_str();
  app.add_option("--config", arguments.config, "Configuration file; default: the defaults");
  app.add_option("--set", arguments.overrides, "section.key=value, wins over the file; may be given again")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

generate::SensedFlightOptions optionsOf(const Arguments& arguments) {
  constexpr int kWidth_px = 320;
  constexpr int kHeight_px = 240;
  generate::SensedFlightOptions options = arguments.options;
  options.camera = generate::paperCamera(kWidth_px, kHeight_px);
  options.vio.drift.horizontal_std_m = arguments.drift_5s_m;
  options.vio.drift.vertical_std_m = arguments.drift_5s_m;
  options.vio.drift.after = std::chrono::seconds(5);
  return options;
}

std::string summaryOf(const generate::SensedFlight& flight, const generate::SensedFlightSummary& sensed,
                      const PlannedFlightSummary& planned) {
  const double flown_s = toSeconds(planned.end - flight.options().start);
  Text text;
  text.line("scene '{}', seed {}: {} after {:.1f} s and {:.1f} m", flight.options().scene, flight.options().seed,
            toString(planned.outcome), flown_s, sensed.flown_m);
  text.line("speed: mean {:.2f} m/s, top {:.2f} m/s; clearance {:.2f} m or more", sensed.flown_m / flown_s,
            planned.top_speed_m_s, planned.min_clearance_m);
  text.line("tracking error: rms {:.3f} m, max {:.3f} m; drift at the end {:.2f} m",
            std::sqrt(planned.tracking.square_sum_m2 / static_cast<double>(planned.tracking.count)),
            planned.tracking.worst_m, sensed.final_error_m);
  writePlans(text, planned.plans);
  return text.take();
}

/// @return did it arrive?
bool run(const Arguments& arguments) {
  const Configuration configuration = loadConfiguration(arguments.config, arguments.overrides);
  const generate::SensedFlight flight(optionsOf(arguments));
  LogWriter log(arguments.log);
  PlannedFlyer flyer(configuration, flight.scene(), flight.options().start, {}, log);
  const generate::SensedFlightSummary sensed =
      flight.record(configuration.lcm, fromSeconds(arguments.duration_s), flyer, log);
  log.close();
  fmt::print("{}", summaryOf(flight, sensed, flyer.summary()));
  return flyer.summary().outcome == Outcome::kAtGoal;
}

}  // namespace
}  // namespace nanomap::sim

int main(int argc, char** argv) {
  CLI::App app(
      "Flies a simulated vehicle through a scene as the planner decides, in simulated time, and records the flight.\n"
      "Exit code 0: it stands at the goal; 2: it does not; 1: it could not be flown.",
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
