#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/generate/flight_log.h"
#include "tools/generate/paper_camera.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::generate {
namespace {

/// The command line, in its own units.
struct Arguments {
  std::filesystem::path log;
  FlightLogOptions options;
  std::optional<double> duration_s;
  std::string camera = "320x240";
  double range_m = 20.0;
  bool noise = true;
  bool raw = false;
  double drift_5s_m = 0.3;
  double correction_delay_s = 0.2;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  FlightLogOptions& options = arguments.options;
  app.option_defaults()->take_last();
  app.add_option("--out", arguments.log, "LCM log to write; an existing one is replaced")->required();
  app.add_option("--scene", options.scene, "What to fly through")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(simulation::kSceneNames.begin(), simulation::kSceneNames.end())));
  app.add_option("--seed", options.seed, "Draws scene, flight, noise and drift; the same seed writes the same log")
      ->capture_default_str();
  app.add_option("--duration", arguments.duration_s, "Length of the log [s]; default: until the goal is reached");
  app.add_option("--speed", options.flight.cruise_speed_m_s, "Cruise speed [m/s]")->capture_default_str();
  app.add_option("--camera", arguments.camera, "Depth image size, WIDTHxHEIGHT; it sees 90 x 60 degrees")
      ->capture_default_str();
  app.add_option("--range", arguments.range_m, "Farthest depth to be trusted [m]")->capture_default_str();
  app.add_option("--sensor-range", options.sensor.max_range_m, "Farthest depth with a return [m]")
      ->capture_default_str();
  app.add_option("--depth-hz", options.depth_hz, "Depth images a second [Hz]")->capture_default_str();
  app.add_option("--noise", arguments.noise, "on: noise, dropouts, stereo shadows and steps; off: exact depth")
      ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}))
      ->option_text("on|off");
  app.add_flag("--raw", arguments.raw, "Depth images uncompressed");
  app.add_option("--drift-5s", arguments.drift_5s_m, "Standard deviation of position drift after 5 s, on each axis [m]")
      ->capture_default_str();
  app.add_option("--drift-law", options.vio.drift.law, "sqrt: error that wanders; linear: wrong velocity")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, GrowthLaw>{{"sqrt", GrowthLaw::kSquareRoot}, {"linear", GrowthLaw::kLinear}}))
      ->option_text("sqrt|linear");
  app.add_option("--correction-hz", options.correction_hz, "Sliding-window corrections a second [Hz]; 0: none")
      ->capture_default_str();
  app.add_option("--correction-delay", arguments.correction_delay_s, "How late a correction arrives [s]")
      ->capture_default_str();
  app.add_option("--jump", options.jump_m, "How far the estimator's world jumps halfway [m]")->capture_default_str();
  app.add_option("--pose-type", options.pose_type,
                 "body_pose (nanomap.body_pose_t) or pose_t (bot_core.pose_t: no epoch, no increment covariance)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, PoseType>{{"body_pose", PoseType::kBodyPose}, {"pose_t", PoseType::kPose}}))
      ->option_text("body_pose|pose_t");
}

CameraParameters parseCamera(const std::string& size, double range_m) {
  int width_px = 0;
  int height_px = 0;
  int used = 0;
  if (std::sscanf(size.c_str(), "%dx%d%n", &width_px, &height_px, &used) != 2 ||
      static_cast<std::size_t>(used) != size.size()) {
    throw std::invalid_argument(fmt::format("--camera {}: give WIDTHxHEIGHT, 320x240 say", size));
  }
  CameraParameters camera = paperCamera(width_px, height_px);
  camera.max_range_m = range_m;
  return camera;
}

FlightLogOptions optionsOf(const Arguments& arguments) {
  FlightLogOptions options = arguments.options;
  options.camera = parseCamera(arguments.camera, arguments.range_m);
  if (arguments.duration_s) options.duration = fromSeconds(*arguments.duration_s);
  if (!arguments.noise) {
    const double sensor_range_m = options.sensor.max_range_m;
    options.sensor = simulation::DepthSensorParameters::ideal();
    options.sensor.max_range_m = sensor_range_m;
  }
  if (arguments.raw) options.compression = DepthCompression::kRaw;
  options.vio.drift.horizontal_std_m = arguments.drift_5s_m;
  options.vio.drift.vertical_std_m = arguments.drift_5s_m;
  options.vio.drift.after = std::chrono::seconds(5);
  options.correction_delay = fromSeconds(arguments.correction_delay_s);
  return options;
}

void print(const Arguments& arguments, const FlightLog& flight, const SensedFlightSummary& summary) {
  fmt::print("{}: {:.1f} s through scene '{}' (seed {}, {} obstacles), {:.1f} m flown, clearance {:.2f} m or more\n",
             arguments.log.string(), toSeconds(flight.duration()), flight.scene().name(), arguments.options.seed,
             flight.scene().obstacles().size(), summary.flown_m, summary.min_clearance_m);
  fmt::print("depth {} at {:g} Hz, {:.1f} % of pixels with a return; drift at the end {:.2f} m; {:.1f} MB\n",
             arguments.camera, arguments.options.depth_hz, 100.0 * summary.depth_share, summary.final_error_m,
             static_cast<double>(std::filesystem::file_size(arguments.log)) / 1e6);
  for (const auto& [channel, count] : summary.messages) fmt::print("  {:<16} {:>6}\n", channel, count);
}

void run(const Arguments& arguments) {
  const FlightLog flight(optionsOf(arguments));
  LogWriter log(arguments.log);
  const SensedFlightSummary summary = flight.write(LcmParameters(), log);
  log.close();
  print(arguments, flight, summary);
}

}  // namespace
}  // namespace nanomap::generate

int main(int argc, char** argv) {
  CLI::App app("Ray-casts a simulated flight into an LCM log.", "nanomap-generate");
  nanomap::generate::Arguments arguments;
  nanomap::generate::addOptions(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    nanomap::generate::run(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-generate: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
