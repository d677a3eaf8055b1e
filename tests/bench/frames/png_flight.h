#pragma once

#include <cstddef>
#include <filesystem>

#include "core/camera_model.h"
#include "tests/bench/frames/recorded_flight.h"

namespace nanomap::bench {

/// The first `max_frames` frames of a folder of `NNNNNN.depth.png`, each with its `NNNNNN.pose.txt`, at 30 Hz.
/// @throws std::runtime_error naming the file that is missing, damaged or not of the camera's size
[[nodiscard]] RecordedFlight readPngFlight(const std::filesystem::path& folder, const CameraParameters& camera,
                                           std::size_t max_frames);

}  // namespace nanomap::bench
