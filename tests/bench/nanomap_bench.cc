#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/bench/frames/generated_scene.h"
#include "tests/bench/frames/recorded_flight.h"
#include "tests/bench/frames/scenario.h"
#include "tests/bench/report/scoreboard.h"
#include "tests/bench/rows/certified_survey.h"
#include "tests/bench/rows/chain_fixture.h"
#include "tests/bench/rows/effort.h"
#include "tests/bench/rows/plan_times.h"
#include "tests/bench/rows/workload.h"
#include "tools/generate/paper_camera.h"
#include "tools/import/camera_preset.h"

namespace nanomap::bench {
namespace {

struct Scene {
  std::string_view name;
  Noise noise;
};
/// Google Benchmark runs on the first.
constexpr std::array kScenes = {Scene{"forest", Noise::kNoisy}, Scene{"forest", Noise::kClean},
                                Scene{"warehouse", Noise::kNoisy}, Scene{"warehouse", Noise::kClean}};

struct Options {
  bool ratios = false;
  bool certified = false;
  bool quick = false;
  std::filesystem::path json;
  std::filesystem::path depth_folder;
  std::string camera_preset = "kinect-office";
};

void addOptions(CLI::App& app, Options& options) {
  app.add_flag("--ratios", options.ratios,
               "Print one line a row, `name value bar ok|short`; exit with 1 if one is short. Without it, Google "
               "Benchmark runs, on one scene, and takes its own options");
  app.add_flag("--certified", options.certified,
               "Print what certified clearance is worth and costs, against the true clearance of generated scenes")
      ->excludes("--ratios");
  app.add_flag("--quick", options.quick, "Hardly measure: shows that everything works, the figures say nothing");
  app.add_option("--json", options.json, "Write the results to this file as well");
  app.add_option("--depth-dir", options.depth_folder,
                 "Run on a folder of NNNNNN.depth.png and NNNNNN.pose.txt instead of generated frames")
      ->check(CLI::ExistingDirectory);
  std::vector<std::string> presets;
  for (const CameraPreset& preset : cameraPresets()) presets.emplace_back(preset.name);
  app.add_option("--camera-preset", options.camera_preset, "Calibration of the folder's camera")
      ->capture_default_str()
      ->check(CLI::IsMember(presets));
  app.allow_extras();
}

Scenario recordedScenario(const Options& options, const Effort& effort) {
  return readScenario(options.depth_folder, *findCameraPreset(options.camera_preset), effort.history);
}

/// Plans over frames of which the sensor lost a third: gaps cost more to judge than depths. No row is for them.
void timePatchyPlans(const Effort& effort, Scoreboard& scoreboard) {
  const RecordedFlight flight =
      GeneratedScene("forest").fly(generate::paperCamera(320, 240), Noise::kPatchy, {0, effort.history + 1});
  const PlanTimes plans(std::make_shared<ChainFixture>(flight, effort.history), effort.plans);
  plans.record(scoreboard, effort.long_rounds, "forest_patchy");
}

int runRatios(const Options& options, const Effort& effort) {
  Scoreboard scoreboard;
  const bool generated = options.depth_folder.empty();
  if (generated) {
    for (const auto& [scene, noise] : kScenes) {
      Workload(generateScenario(scene, noise, effort.history), effort).measure(scoreboard);
    }
    timePatchyPlans(effort, scoreboard);
  } else {
    Workload(recordedScenario(options, effort), effort).measure(scoreboard);
    scoreboard.remark("the bars are for generated frames of 320x240");
  }
#ifndef NANOMAP_BENCH_OCTOMAP
  scoreboard.remark("OctoMap was not found when this was built: it is not compared with");
#endif
  scoreboard.print(generated);
  if (!options.json.empty()) scoreboard.writeJson(options.json);
  return scoreboard.allReached(generated) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int runSurvey(const Effort& effort) {
  std::vector<CertifiedFigures> figures;
  for (const std::string_view scene : {"forest", "warehouse", "urban"}) {
    for (const Noise noise : {Noise::kNoisy, Noise::kClean}) {
      std::ranges::move(surveyCertificates(scene, noise, effort.history, effort.nearest_queries),
                        std::back_inserter(figures));
    }
  }
  print(figures);
  return EXIT_SUCCESS;
}

void registerBenchmark(const std::string& name, const Contestant& contestant) {
  benchmark::RegisterBenchmark(name.c_str(), [contestant](benchmark::State& state) {
    for (auto _ : state) {
      if (contestant.prepare) {
        state.PauseTiming();
        contestant.prepare();
        state.ResumeTiming();
      }
      contestant.run();
    }
    state.counters["item"] = benchmark::Counter(
        contestant.items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  })->Unit(benchmark::kMicrosecond);
}

/// Google Benchmark takes what is left of the command line, and says what it does not know.
int runBenchmarks(const Options& options, const Effort& effort, std::vector<std::string> arguments) {
  if (!options.json.empty()) {
    arguments.push_back("--benchmark_out=" + options.json.string());
    arguments.push_back("--benchmark_out_format=json");
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);  // as main's ends
  benchmark::Initialize(&argc, argv.data());
  if (benchmark::ReportUnrecognizedArguments(argc, argv.data())) return EXIT_FAILURE;

  const auto& [scene, noise] = kScenes.front();
  const Workload workload(
      options.depth_folder.empty() ? generateScenario(scene, noise, effort.history) : recordedScenario(options, effort),
      effort);
  for (const Contest& contest : workload.contests()) {
    for (const Contestant& contestant : contest.contestants) {
      registerBenchmark(contest.name + "/" + contestant.name, contestant);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace nanomap::bench

int main(int argc, char** argv) {
  using namespace nanomap::bench;
  CLI::App app("Measures NanoMap against its references, all in one run.", "nanomap-bench");
  Options options;
  addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    const Effort effort = options.quick ? Effort::quick() : Effort();
    std::vector<std::string> others = app.remaining();
    if (!options.ratios && !options.certified) {
      others.insert(others.begin(), app.get_name());
      return runBenchmarks(options, effort, std::move(others));
    }
    if (!others.empty()) throw std::invalid_argument(others.front() + ": not an option of this");
    if (options.certified) return runSurvey(effort);
    return runRatios(options, effort);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-bench: {}\n", error.what());
    return 2;
  }
}
