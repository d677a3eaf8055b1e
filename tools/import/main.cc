#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "firmware_app/configuration/camera_mount.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/import/camera_preset.h"
#include "tools/import/depth_png.h"
#include "tools/import/numbered_layout.h"
#include "tools/import/recording.h"
#include "tools/import/recording_export.h"
#include "tools/import/tum_layout.h"

namespace nanomap {
namespace {

enum class Layout { kAutomatic, kNumbered, kTum };

/// Axes of the recording's world. The log's world is FLU: z up.
enum class WorldAxes { kFlu, kRdf };

/// What the command line says; what it leaves open comes from the preset or the layout.
struct Options {
  std::filesystem::path folder;
  std::filesystem::path log;
  Layout layout = Layout::kAutomatic;
  std::string preset;
  std::optional<WorldAxes> world_axes;
  double rate_hz = 30.0;
  std::optional<double> fx_px;
  std::optional<double> fy_px;
  std::optional<double> cx_px;
  std::optional<double> cy_px;
  std::vector<double> distortion;
  std::optional<double> depth_unit_m;
  std::optional<double> min_range_m;
  std::optional<double> max_range_m;
  std::vector<std::uint16_t> no_return_values;
  std::size_t every = 1;
  std::size_t max_frames = std::numeric_limits<std::size_t>::max();
};

void addOptions(CLI::App& app, Options& options) {
  app.add_option("folder", options.folder, "Folder of the recording")->required()->check(CLI::ExistingDirectory);
  app.add_option("--out", options.log, "LCM log to write; an existing one is replaced")->required();
  app.add_option("--layout", options.layout,
                 "numbered: NNNNNN.depth.png and NNNNNN.pose.txt; tum: depth.txt and groundtruth.txt; "
                 "auto (default): by what is there")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Layout>{
          {"auto", Layout::kAutomatic}, {"numbered", Layout::kNumbered}, {"tum", Layout::kTum}}))
      ->option_text("auto|numbered|tum");
  app.add_option(
         "--world", options.world_axes,
         "Axes of the poses' world: flu (z up; default for tum) or rdf (like a level camera's: z forward, y down; "
         "default for the numbered layout, whose world is that of a first frame)")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, WorldAxes>{{"flu", WorldAxes::kFlu}, {"rdf", WorldAxes::kRdf}}))
      ->option_text("flu|rdf");
  std::vector<std::string> presets;
  for (const CameraPreset& preset : cameraPresets()) presets.emplace_back(preset.name);
  app.add_option("--preset", options.preset, "Published calibration; the options below override it")
      ->check(CLI::IsMember(presets));
  app.add_option("--rate", options.rate_hz, "Frames a second of the numbered layout [Hz]")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 100'000.0));
  app.add_option("--fx", options.fx_px, "Focal length, horizontal [px]");
  app.add_option("--fy", options.fy_px, "Focal length, vertical [px]");
  app.add_option("--cx", options.cx_px, "Principal point, column [px], pixel centres at integers");
  app.add_option("--cy", options.cy_px, "Principal point, row [px]");
  app.add_option("--distortion", options.distortion, "Brown-Conrady k1,k2,p1,p2,k3")->delimiter(',')->expected(5);
  app.add_option("--depth-unit", options.depth_unit_m,
                 "Metres per count; 0.001 for the numbered layout, 0.0002 for tum");
  app.add_option("--min-range", options.min_range_m, "Nearest depth to be trusted [m]");
  app.add_option("--max-range", options.max_range_m, "Farthest depth to be trusted [m]");
  app.add_option("--no-return", options.no_return_values, "Raw values that mean no depth; 0,65535 by default")
      ->delimiter(',');
  app.add_option("--every", options.every, "Take every N-th frame")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--max-frames", options.max_frames, "Take at most so many frames")->check(CLI::PositiveNumber);
}

bool isTum(const Options& options) {
  return options.layout == Layout::kTum || (options.layout == Layout::kAutomatic && isTumLayout(options.folder));
}

CameraParameters cameraOf(const Options& options, const DepthPng& first) {
  CameraParameters camera;
  if (!options.preset.empty()) {
    camera = *findCameraPreset(options.preset);
  } else {
    if (!options.fx_px || !options.fy_px || !options.cx_px || !options.cy_px || !options.max_range_m) {
      throw std::runtime_error("camera unknown: give --preset, or --fx --fy --cx --cy and --max-range");
    }
    camera.width_px = first.width_px;
    camera.height_px = first.height_px;
    camera.T_B_C.rotation = rotationOfMount({});
    camera.depth_unit_m = isTum(options) ? kTumDepthUnit_m : kNumberedDepthUnit_m;
  }
  camera.fx_px = options.fx_px.value_or(camera.fx_px);
  camera.fy_px = options.fy_px.value_or(camera.fy_px);
  camera.cx_px = options.cx_px.value_or(camera.cx_px);
  camera.cy_px = options.cy_px.value_or(camera.cy_px);
  if (const auto& d = options.distortion; !d.empty()) camera.distortion = {d[0], d[1], d[2], d[3], d[4]};
  camera.depth_unit_m = options.depth_unit_m.value_or(camera.depth_unit_m);
  camera.min_range_m = options.min_range_m.value_or(camera.min_range_m);
  camera.max_range_m = options.max_range_m.value_or(camera.max_range_m);
  if (!options.no_return_values.empty()) camera.no_return_values = options.no_return_values;
  return CameraModel(camera).parameters();  // judges it
}

/// Writes beside the log and renames, so that a recording with a fault in its middle leaves an older log as it was.
ExportCounts writeLog(const Options& options, const Recording& recording, const CameraParameters& camera) {
  const std::filesystem::path part = std::filesystem::path(options.log).concat(".part");
  try {
    LogWriter log(part);
    const ExportCounts counts = writeRecording(recording, camera, LcmParameters(), log);
    log.close();
    std::filesystem::rename(part, options.log);
    return counts;
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

Recording readFolder(const Options& options) {
  const bool tum = isTum(options);
  Recording recording = tum ? readTumLayout(options.folder) : readNumberedLayout(options.folder, options.rate_hz);
  if (options.world_axes.value_or(tum ? WorldAxes::kFlu : WorldAxes::kRdf) == WorldAxes::kRdf) {
    // A level camera's axes turn into the world's as those of a camera that looks straight ahead into the body's.
    const Pose T_W_recorded{rotationOfMount({}), Vec3::Zero()};
    for (RecordedPose& pose : recording.poses) pose.T_W_C = T_W_recorded * pose.T_W_C;
  }
  return select(std::move(recording), options.every, options.max_frames);
}

void run(const Options& options) {
  const Recording recording = readFolder(options);
  const CameraParameters camera = cameraOf(options, readDepthPng(recording.images.front().file));
  const ExportCounts counts = writeLog(options, recording, camera);

  fmt::print("{}: {} images of {}x{} px, {} poses, {:.3f} s\n", options.log.string(), counts.images, camera.width_px,
             camera.height_px, counts.poses, toSeconds(recording.images.back().stamp - recording.images.front().stamp));
  if (counts.images_without_pose > 0) {
    fmt::print("{} images lie outside the time of the poses\n", counts.images_without_pose);
  }
}

}  // namespace
}  // namespace nanomap

int main(int argc, char** argv) {
  CLI::App app("Turns a folder of 16-bit depth PNGs with camera poses into an LCM log.", "nanomap-import");
  nanomap::Options options;
  nanomap::addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    nanomap::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-import: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
