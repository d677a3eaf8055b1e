#include "tools/sim/arguments.h"

#include "tools/generate/paper_camera.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::sim {
namespace {

constexpr const char* kCameraOff = "--camera-off";
constexpr const char* kVioOff = "--vio-off";
constexpr const char* kVioJump = "--vio-jump";
constexpr const char* kFault = "--fault";

}  // namespace

void addOptions(CLI::App& app, Arguments& arguments) {
  generate::SensedFlightOptions& options = arguments.options;
  app.option_defaults()->take_last();
  app.add_option("--scene", options.scene, "What to fly through")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(simulation::kSceneNames.begin(), simulation::kSceneNames.end())));
  app.add_option("--seed", options.seed, "Draws scene, noise and drift; the same seed flies the same flight")
      ->capture_default_str();
  app.add_option("--speed", options.goal_speed_m_s,
                 "Top speed that comes with the goal [m/s]; the last one given holds")
      ->capture_default_str()
      ->take_last();
  app.add_option("--duration", arguments.duration_s, "Give up after [s]")->capture_default_str();
  app.add_option("--drift-5s", arguments.drift_5s_m, "Standard deviation of position drift after 5 s, on each axis [m]")
      ->capture_default_str();
  app.add_option("--correction-hz", options.correction_hz, "Sliding-window corrections a second [Hz]; 0: none")
      ->capture_default_str();
  app.add_option("--patches", options.sensor.patch_share,
                 "Share of each depth image that is lost in patches, others each time: no texture, or glare")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.9));
  app.add_flag("--raw", arguments.raw, "Depth images uncompressed");
  app.add_option(kCameraOff, arguments.camera_off, "The camera is off from T s after the departure on, for D s")
      ->option_text("T:D");
  app.add_option(kVioOff, arguments.vio_off, "Likewise the estimator")->option_text("T:D");
  app.add_option(kVioJump, arguments.vio_jump, "The estimator's world jumps by M m, T s after the departure")
      ->option_text("T:M");
  app.add_option("--config", arguments.config, "Configuration file; default: the defaults");
  app.add_option("--set", arguments.overrides, "section.key=value, wins over the file; may be given again")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  CLI::Option* const record = app.add_option("--record", arguments.recordings,
                                             "Folder to record the flight in, as nanomap-flight does, with the truth");
  CLI::Option* const flights =
      app.add_option("--flights", arguments.flights, "Fly as many, of seeds from --seed on, and print a table")
          ->capture_default_str()
          ->check(CLI::Range(1, 1000))
          ->excludes(record);
  CLI::Option* const blind =
      app.add_flag("--blind", arguments.blind, "No obstacle weighs anything: a crash, if the scene is of use");

  CLI::Option* const live =
      app.add_flag("--live", arguments.live,
                   "In real time, over LCM: an autopilot's vehicle flies, by what nanomap-flight tells it")
          ->excludes(record)
          ->excludes(flights)
          ->excludes(blind);
  app.add_option("--out", arguments.log,
                 "LCM log to write of what was published and where the vehicle was; an existing one is replaced")
      ->needs(live);
  app.add_option("--autopilot", arguments.autopilot_url,
                 "Where the autopilot tells where its vehicle is, as MAVSDK takes it; nanomap-flight has another one")
      ->capture_default_str()
      ->needs(live);
  app.add_option(kFault, arguments.message_faults,
                 "What befalls messages from T s after the departure on, for D s: " + namesOfMessageFaults() +
                     "; may be given again")
      ->option_text("WHAT:T:D")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(live);
  app.add_option("--heading", arguments.heading_deg,
                 "Of the way to the goal, clockwise from north [degrees]; default: the vehicle's own at first")
      ->needs(live);
}

generate::SensedFlightOptions sensedFlightOf(const Arguments& arguments) {
  constexpr int kWidth_px = 320;
  constexpr int kHeight_px = 240;
  generate::SensedFlightOptions options = arguments.options;
  options.camera = generate::paperCamera(kWidth_px, kHeight_px);
  options.vio.drift.horizontal_std_m = arguments.drift_5s_m;
  options.vio.drift.vertical_std_m = arguments.drift_5s_m;
  options.vio.drift.after = std::chrono::seconds(5);
  if (arguments.raw) options.compression = DepthCompression::kRaw;
  return options;
}

SensorFaultPlanParameters faultsOf(const Arguments& arguments) {
  SensorFaultPlanParameters faults;
  if (!arguments.camera_off.empty()) faults.camera = parseOutage(kCameraOff, arguments.camera_off);
  if (!arguments.vio_off.empty()) faults.estimator = parseOutage(kVioOff, arguments.vio_off);
  if (!arguments.vio_jump.empty()) faults.jump = parseJump(kVioJump, arguments.vio_jump);
  return faults;
}

std::vector<PlannedMessageFault> messageFaultsOf(const Arguments& arguments) {
  std::vector<PlannedMessageFault> faults;
  for (const std::string& text : arguments.message_faults) faults.push_back(parseMessageFault(kFault, text));
  return faults;
}

}  // namespace nanomap::sim
