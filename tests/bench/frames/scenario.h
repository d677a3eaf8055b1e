#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera_model.h"
#include "tests/bench/frames/generated_scene.h"
#include "tests/bench/frames/recorded_flight.h"

namespace nanomap::bench {

/// What one set of measurements works on.
struct Scenario {
  std::string name;
  Noise noise = Noise::kNoisy;
  std::size_t history = 0;  ///< views of the chain
  RecordedFlight flight;    ///< one frame more than that: it is inserted
  // Generated scenarios only:
  std::optional<RecordedFlight> hover;  ///< as many frames
  std::optional<RecordedFlight> wide;   ///< the last frame of `flight` once more, 848x480
};

/// A scene of the simulator with the paper's camera, 320x240. @throws std::exception naming the scene
[[nodiscard]] Scenario generateScenario(std::string_view scene, Noise noise, std::size_t history);

/// A folder of depth PNGs (frames/png_flight.h). The history is shortened to what there is.
/// @throws std::runtime_error naming the folder or file at fault, also if it holds less than two frames
[[nodiscard]] Scenario readScenario(const std::filesystem::path& folder, const CameraParameters& camera,
                                    std::size_t history);

}  // namespace nanomap::bench
