#include "tests/bench/frames/scenario.h"

#include <algorithm>
#include <stdexcept>

#include "tests/bench/frames/png_flight.h"
#include "tools/generate/paper_camera.h"

namespace nanomap::bench {

Scenario generateScenario(std::string_view scene, Noise noise, std::size_t history) {
  const GeneratedScene generated(scene);
  const CameraParameters camera = generate::paperCamera(320, 240);
  const GeneratedScene::FrameRange all{0, history + 1};
  const GeneratedScene::FrameRange last{history, 1};
  return {.name = std::string(scene) + (noise == Noise::kClean ? "_clean" : "_noisy"),
          .noise = noise,
          .history = history,
          .flight = generated.fly(camera, noise, all),
          .hover = generated.hover(camera, noise, all),
          .wide = generated.fly(generate::paperCamera(848, 480), noise, last)};
}

Scenario readScenario(const std::filesystem::path& folder, const CameraParameters& camera, std::size_t history) {
  RecordedFlight flight = readPngFlight(folder, camera, history + 1);
  if (flight.frames.size() < 2) throw std::runtime_error(folder.string() + ": two frames are needed");
  return {.name = folder.filename().string(),
          .noise = Noise::kNoisy,
          .history = flight.frames.size() - 1,
          .flight = std::move(flight),
          .hover = {},
          .wide = {}};
}

}  // namespace nanomap::bench
